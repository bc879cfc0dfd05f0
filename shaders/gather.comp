// The gather with rays through the hierarchy of bvh.h, for every device.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "picture.glsl"
