#version 300 es
/* A corner of a triangle. There are no vertex attributes: the number of the vertex tells the
 * triangle, that the element, and textures have the nodes of elements and the places of nodes.
 * Elements are in an order with triangles first; a quadrilateral a b c d is drawn as a b c, a c d. */
precision highp float;
precision highp int;
precision highp usampler2D;

uniform sampler2D nodes;      /* x y z about the middle of the scene, metres */
uniform usampler2D elements;  /* four nodes, the fourth of a triangle unused */
uniform int triangles;        /* elements with three corners */
uniform mat4 camera;
uniform float stretch;        /* of heights */

flat out int element;
flat out vec3 normal;         /* of the triangle as it is drawn */
out float height;             /* not stretched */
out vec3 edges;               /* 0 on an edge to 1 in the corner opposite; 1 on a diagonal */

ivec2 place(int k)
{
    return ivec2(k & 2047, k >> 11);
}

vec3 node(uint k)
{
    return texelFetch(nodes, place(int(k)), 0).xyz;
}

void main()
{
    int triangle = gl_VertexID / 3, corner = gl_VertexID % 3, half_of = 0;
    element = triangle;
    if (triangle >= triangles) {
        element = triangles + (triangle - triangles) / 2;
        half_of = 1 + (triangle - triangles) % 2;
    }
    uvec4 n = texelFetch(elements, place(element), 0);
    vec3 p[3] = vec3[3](node(n.x), node(half_of == 2 ? n.z : n.y), node(half_of == 2 ? n.w : n.z));
    vec3 up = vec3(1.0, 1.0, stretch);
    normal = normalize(cross((p[1] - p[0]) * up, (p[2] - p[0]) * up));
    edges = vec3(corner == 0, corner == 1, corner == 2);
    if (half_of == 1)
        edges.y = 1.0;
    if (half_of == 2)
        edges.z = 1.0;
    height = p[corner].z;
    gl_Position = camera * vec4(p[corner] * up, 1.0);
}
