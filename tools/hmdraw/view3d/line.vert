#version 300 es
/* A piece of a line, as a rectangle on the screen: one instance, four vertices in a strip. */
precision highp float;
precision highp int;

in vec3 from;
in vec3 to;
uniform mat4 camera;
uniform float stretch;
uniform vec2 screen;          /* pixels */
uniform float width;          /* pixels */

void main()
{
    vec3 up = vec3(1.0, 1.0, stretch);
    vec4 a = camera * vec4(from * up, 1.0), b = camera * vec4(to * up, 1.0);
    /* what lies behind the eye would come out mirrored */
    const float least = 1e-3;
    if (a.w < least)
        a = mix(a, b, (least - a.w) / max(b.w - a.w, 1e-9));
    if (b.w < least)
        b = mix(b, a, (least - b.w) / max(a.w - b.w, 1e-9));
    vec2 way = (b.xy / b.w - a.xy / a.w) * screen;
    vec2 along = length(way) > 0.0 ? normalize(way) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    bool end = gl_VertexID > 1, left = (gl_VertexID & 1) == 1;
    vec4 p = end ? b : a;
    p.xy += (across * (left ? 1.0 : -1.0) + along * (end ? 1.0 : -1.0)) * width / screen * p.w;
    p.z -= 4e-4 * p.w;        /* in front of the surface it lies on */
    gl_Position = p;
}
