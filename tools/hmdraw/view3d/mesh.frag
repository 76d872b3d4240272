#version 300 es
/* The surface: colour by height or by the element's class, light from north-west as on the map,
 * wires that fade where elements are small on the screen. */
precision highp float;
precision highp int;

uniform sampler2D ramp;       /* colours of heights, low to high */
uniform sampler2D colours;    /* of elements */
uniform bool by_height;
uniform vec2 range;           /* of the ramp */
uniform float wires;          /* 0: none */

flat in int element;
flat in vec3 normal;
in float height;
in vec3 edges;
out vec4 colour;

/* Lambert's law, 1 on level ground, from a sun 45° high in the north-west. */
float light()
{
    vec3 up = normal.z < 0.0 ? -normal : normal;
    return 0.5 + 0.5 * min(1.5, max(0.0, dot(up, vec3(-0.7071, 0.7071, 1.0))));
}

/* How much of the pixel is wire: lines a pixel wide, fainter the smaller the triangle. */
float wire()
{
    vec3 step = fwidth(edges);
    vec3 pixels = edges / max(step, 1e-6);
    float size = 1.0 / max(max(step.x, step.y), max(step.z, 1e-6));
    float near = min(pixels.x, min(pixels.y, pixels.z));
    return (1.0 - smoothstep(0.3, 1.0, near)) * smoothstep(1.5, 9.0, size);
}

void main()
{
    vec3 c = by_height ? texture(ramp, vec2((height - range.x) / (range.y - range.x), 0.5)).rgb
                       : texelFetch(colours, ivec2(element & 2047, element >> 11), 0).rgb;
    c = min(c * light(), vec3(1.0));
    colour = vec4(mix(c, vec3(0.13, 0.13, 0.15), 0.5 * wires * wire()), 1.0);
}
