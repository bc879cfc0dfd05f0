// The specialization constants of culling, visibility and gather, one a row: type, name, default. The id of a row is
// the line it stands on, so that no number is written by hand. GLSL declares a constant for each row, C++ a member of
// FrameConstants (gather/constants.h). Whoever includes this says in LW_CONSTANT what a row becomes.

// What the scene has (gather/resident).
// A row that is broken has two lines, and compilers differ in which of them counts.
// clang-format off
LW_CONSTANT(bool, has_uv0, true)
LW_CONSTANT(bool, has_uv1, true)
LW_CONSTANT(bool, has_colors, true)  // of vertices
LW_CONSTANT(bool, has_tangents, true)
LW_CONSTANT(bool, has_textures, true)
LW_CONSTANT(bool, has_metallic_roughness_textures, true)
LW_CONSTANT(bool, has_emissive_textures, true)
LW_CONSTANT(bool, has_transmission_textures, true)
LW_CONSTANT(bool, has_alpha, true)         // masks or blends
LW_CONSTANT(bool, has_transmission, true)  // glass
LW_CONSTANT(bool, has_area_lamps, true)    // lamps that are not delta lights
LW_CONSTANT(bool, has_profiles, true)      // lamps with a photometric file
// What the map has.
LW_CONSTANT(bool, has_directions, true)  // of photons
LW_CONSTANT(bool, has_coverage, true)
LW_CONSTANT(bool, has_visible_lamps, true)
LW_CONSTANT(bool, has_shadow_masks, true)
LW_CONSTANT(bool, has_caustics, true)
LW_CONSTANT(bool, has_smooth_caustics, true)  // at the nodes of the lattice
LW_CONSTANT(uint, chunks, 1u)                 // buffers that the photon records are split over
LW_CONSTANT(uint, chunk_shift, 27u)           // a buffer holds 2^chunk_shift records
// How light is gathered (gather/gather_pass).
LW_CONSTANT(uint, gather_mode, gather_mode_smooth)
LW_CONSTANT(uint, heap_size, 256u)  // of the exact mode: at least the neighbours, a power of two
LW_CONSTANT(uint, stage, stage_photons)
LW_CONSTANT(bool, of_followed, false)  // photons and rays at the ends of followed paths, not at what pixels see
LW_CONSTANT(bool, has_direct, true)    // lamps' own light comes by rays and the lattice, not by photons
LW_CONSTANT(bool, has_shadow_rays, true)
LW_CONSTANT(bool, has_followed, true)         // view paths go on from some surfaces
LW_CONSTANT(float, followed_roughness, 0.0f)  // lobes of smoother surfaces are followed
LW_CONSTANT(bool, follows_through, true)      // glass and blends are surfaces of the view, what is behind is followed
LW_CONSTANT(uint, first_see_through, no_grid)  // with ray queries: first triangle that may let light through
// Which triangles are drawn (gather/cull_pass).
LW_CONSTANT(uint, first_listed, 0u)        // where the triangles of a draw begin in the list
LW_CONSTANT(float, pixel_margin, 0.0625f)  // pixels by which a triangle may reach beyond its box
