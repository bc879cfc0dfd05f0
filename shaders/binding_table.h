// All descriptors, one a row: set, name, type, how many, which shaders read it. The binding of a row is the line it
// stands on, so that no number is written by hand. bindings.h makes the constants binding_NAME of it,
// gather/bindings.cpp the layouts: whoever includes the table says in LW_BINDING what a row becomes.
//
// Arrays read at random are texel buffers, records whole texels: a software rasterizer fetches four words of a texel in
// the time of one word of a storage buffer.
//
// A row that is broken has two lines, and compilers differ in which of them counts.
// clang-format off

// The scene and its map, set 0 (gather/resident). Corners are three per triangle, without indices.
LW_BINDING(scene, corners, texels, 1, all_stages)       // RGBA32F twice: position and u, normal and v of uv0
LW_BINDING(scene, triangles, texels, 1, all_stages)     // RGBA32: grid or cut of front and back, material, light or -1
LW_BINDING(scene, uv1, texels, 1, all_stages)           // RG32F per corner
LW_BINDING(scene, colors, texels, 1, all_stages)        // RGBA32F per corner
LW_BINDING(scene, tangents, texels, 1, all_stages)      // RGBA32F per corner
LW_BINDING(scene, texels, texels, 1, all_stages)        // RGBA8, of all textures
LW_BINDING(scene, materials, texels, 1, all_stages)     // RGBA32, material_texels for each Material
LW_BINDING(scene, textures, texels, 1, all_stages)      // RGBA32, texture_texels for each Texture
LW_BINDING(scene, grids, texels, 1, compute)            // RGBA32, SurfaceGrid
LW_BINDING(scene, cuts, texels, 1, compute)             // RGBA32, Cut
LW_BINDING(scene, cell_starts, texels, 1, compute)      // R32, first photon of each grid cell
LW_BINDING(scene, places, texels, max_chunks, compute)  // RG32, PhotonPlace
LW_BINDING(scene, fluxes, texels, max_chunks, compute)  // R32, RGB9E5 of each photon
LW_BINDING(scene, directions, texels, max_chunks, compute)  // R16, octahedral, of each photon
LW_BINDING(scene, coverage, texels, 1, compute)             // R32 per node of the lattice
LW_BINDING(scene, lattice_light, texels, 1, compute)           // RGBA32 per lattice cell
LW_BINDING(scene, lattice_rows, texels, 1, compute)           // R32, row after row: LatticeLight::rows()
LW_BINDING(scene, shadow_masks, texels, 1, compute)         // RGBA32
LW_BINDING(scene, caustic_grids, texels, 1, compute)        // RG32 per triangle: grid or cut of the front, of the back
LW_BINDING(scene, lamp_powers, texels, 1, compute)          // RGBA32F, LampPower
LW_BINDING(scene, bvh_nodes, texels, 1, compute)        // RGBA32, BvhNode; empty where rays are traced by ray queries
LW_BINDING(scene, bvh_triangles, texels, 1, compute)    // R32
LW_BINDING(scene, lights, storage, 1, compute)          // Light
LW_BINDING(scene, emitters, storage, 1, compute)        // Emitter
LW_BINDING(scene, acceleration, hierarchy, 1, compute)  // where rays are traced by ray queries

// The picture that is made, set 1 (gather/picture).
LW_BINDING(picture, visibility, image, 1, compute)    // what each pixel sees: triangle, barycentrics, depth
LW_BINDING(picture, radiance, storage, 1, compute)    // vec4 per pixel: RGB cd/m2, lx
LW_BINDING(picture, light, texels, 1, compute)        // the same as RGBA32F texels
LW_BINDING(picture, ray_lists, storage, 1, compute)   // RayPixels
LW_BINDING(picture, ray_pixels, storage, 1, compute)  // the pixels of all lists
LW_BINDING(picture, followed, storage, 1, compute)    // Followed per pixel
LW_BINDING(picture, screen, storage, 1, compute)      // RGBA8, R in the low byte

// Which triangles are drawn, set 1 of the passes that cull and draw (cull.h, gather/cull_pass).
LW_BINDING(cull, clusters, texels, 1, compute)    // RGBA32, cluster_texels for each Cluster
LW_BINDING(cull, survivors, storage, 1, compute)  // Survivors, blocks_per_cluster for each Cluster
LW_BINDING(cull, draws, storage, 1, compute)      // DrawArguments of opaque clusters, and of those in see-through ones
LW_BINDING(cull, listed, storage, 1, compute)     // triangles to draw: opaque ones first, others from first_listed on
LW_BINDING(cull, listed_texels, texels, 1, vertex)  // the same as R32 texels

// What the walkthrough shows of pictures, set 0 (view.h, gather/view_pass).
LW_BINDING(view, view_light, texels, 1, compute)  // A: RGB cd/m2, lx; sums over its samples
LW_BINDING(view, view_other, texels, 1, compute)  // B, or what an estimate stands on (inspect.glsl)
LW_BINDING(view, view_visibility, image, 1, compute)
LW_BINDING(view, view_screen, storage, 1, compute)    // what the window shows, 8 bits a channel
LW_BINDING(view, view_readback, storage, 1, compute)  // ReadbackPixel

// The sum over lamps at the lattice, set 0 of its two passes (lamp_sum.h, gather/lamp_sum).
LW_BINDING(lamp_sum, irradiance_marks, texels, 1, compute)     // RG32: marks and starts of PhotonMap::irradiance
LW_BINDING(lamp_sum, irradiance_values, texels, 1, compute)    // R32, RGB9E5
LW_BINDING(lamp_sum, direct_marks, texels, 1, compute)         // RG32: marks and starts of LatticeLight::direct()
LW_BINDING(lamp_sum, direct_values, texels, 1, compute)        // R32, bits of a float
LW_BINDING(lamp_sum, lattice_columns, texels, 1, compute)      // R32 per node: columns, 0 where no lattice cell begins
LW_BINDING(lamp_sum, sum_lattice_rows, texels, 1, compute)       // R32, as lattice_rows
LW_BINDING(lamp_sum, lamp_terms, storage, 1, compute)          // LampTerm
LW_BINDING(lamp_sum, node_sums, storage_window, 1, compute)    // vec4 per node: RGB
LW_BINDING(lamp_sum, node_sum_texels, texels, 1, compute)      // the same as RGBA32F texels
LW_BINDING(lamp_sum, cell_direct, storage_window, 1, compute)  // vec3, four per lattice cell
LW_BINDING(lamp_sum, cell_sums, storage_window, 1, compute)    // uvec4 per lattice cell, as lattice_light
