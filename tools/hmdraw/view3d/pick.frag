#version 300 es
/* The number of the element as a colour, from 1. */
precision highp float;
precision highp int;

flat in int element;
out vec4 colour;

void main()
{
    int k = element + 1;
    colour = vec4(k & 255, k >> 8 & 255, k >> 16 & 255, k >> 24 & 255) / 255.0;
}
