// The gather with rays by the device's ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_ray_query : require
#define LW_RAY_QUERIES
#include "picture.glsl"
