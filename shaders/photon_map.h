// Photon map records and their packing, shared by C++ and GLSL: CPU array = file bytes = GPU bytes.
#ifndef LW_PHOTON_MAP_H
#define LW_PHOTON_MAP_H
#include "kernel.h"
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint no_grid = 0xffffffffu;  // in the place of the number of a grid or cut
LW_CONST uint path_direct = 0u;       // no bounce before this hit
LW_CONST uint path_indirect = 1u;     // at least one diffuse or glossy bounce
LW_CONST uint path_caustic = 2u;      // specular bounces only
LW_CONST uint light_mask = 0x3fffu;   // low 14 bits of light_and_path
LW_CONST uint path_shift = 14u;

/// The static lattice of a patch, independent of its photons: node (i, j) is entry first_node + j * columns + i, at
/// low + (i, j) * step in the u, v of its grid.
struct SurfaceLattice {
    vec2 low;   // m
    vec2 step;  // m
    uint columns;
    uint rows;
    uint first_node;
};

/// The 2D uniform grid of one patch: a triangle, or small triangles of like orientation, seen from one side.
/// Grid cell (i, j) is cell_starts[first_cell + j * columns + i], its end the next entry.
struct SurfaceGrid {
    vec3 origin;      // corner of the grid; position = origin + u u_axis + v v_axis + h normal
    float cell_size;  // m
    vec3 u_axis;
    uint columns;
    vec3 v_axis;
    uint rows;
    vec3 normal;  // oriented to the lit side
    uint first_cell;
    vec3 quantum;    // metres per step of the 16-bit u, v, h of its records
    float h_origin;  // height of step 0 along the normal
    float radius;    // largest search radius in this grid, m
    SurfaceLattice lattice;
};

/// A plane across a surface, along which a wall stands. What lies on the side that the normal points to belongs to
/// `front`, the rest to `back`: a grid, another cut (cut_bit and its number), or no_grid.
struct Cut {
    vec3 point;  // m
    uint front;
    vec3 normal;  // unit
    uint back;
};

/// Where the number of a grid may stand and this bit is set, the other bits are the number of a cut.
LW_CONST uint cut_bit = 0x80000000u;
LW_INLINE bool is_cut(uint index) { return index != no_grid && (index & cut_bit) != 0u; }

/// The grid, or the next cut, of a point of a surface that is cut.
LW_INLINE uint behind_cut(Cut cut, vec3 position) {
    return dot(position - cut.point, cut.normal) > 0.0f ? cut.front : cut.back;
}

LW_CONST uint surface_grid_texels = 7u;  // of 16 bytes
LW_CONST uint cut_texels = 2u;           // of 16 bytes
LW_CONST uint max_cuts_deep = 48u;       // one after the other

/// Coverage of the kernels of radius R/4, R/2, 3R/4 and R of a grid with largest radius R, one byte each.
LW_CONST uint coverage_levels = 4u;
LW_CONST float coverage_unit = 160.0f;  // the byte that stands for coverage 1
LW_CONST float min_coverage = 0.05f;

LW_CONST float caustic_neighbours = 120.0f;  // photons that the kernel of a caustic should hold

// Two tables of bits are kept for the lamps. Each has a row of 32-bit numbers for a node or for a cell of a lattice,
// and each column of a row holds the bits of some lamps.

/// A table of rows for nodes: four bits for a node and a lamp. They tell what the surroundings of the node see of the
/// lamp (some_visible, some_hidden), then the same for the node itself. No bits set: not known.
LW_CONST uint some_visible = 1u;
LW_CONST uint some_hidden = 2u;
LW_CONST uint own_shift = 2u;
LW_CONST uint lamps_per_visibility_column = 8u;
LW_INLINE uint visibility_row_length(uint lamps) {
    return (lamps + lamps_per_visibility_column - 1u) / lamps_per_visibility_column;
}
LW_INLINE uint visibility_column(uint lamp) { return lamp / lamps_per_visibility_column; }
LW_INLINE uint visibility_shift(uint lamp) { return 4u * (lamp % lamps_per_visibility_column); }

/// A table of rows for cells of lattices, each numbered by its lower left node: eight bits for a cell and a lamp. They
/// tell what the surroundings of its corners see (some_visible, some_hidden; no bits: not known), whether the light of
/// its corners holds the lamp, whether it has a shadow mask, and which corners see some of the lamp.
LW_CONST uint in_lattice_light = 4u;
LW_CONST uint has_shadow_mask = 8u;
LW_CONST uint corner_sees = 16u;  // << 0 to 3: corner (0, 0), (1, 0), (0, 1), (1, 1)
LW_CONST uint bits_per_lattice_lamp = 8u;
LW_CONST uint lamps_per_lattice_column = 4u;
LW_INLINE uint lattice_lamp_columns(uint lamps) {
    return (lamps + lamps_per_lattice_column - 1u) / lamps_per_lattice_column;
}
/// The columns of a row: one of marks, if any cell has some, then those of the lamps. The lowest four bits of the marks
/// tell which corners, in the order of corner_sees, hold the caustics; the bits above are the index of the first shadow
/// mask of the cell, whose masks are in the order of lamps.
LW_INLINE uint lattice_row_length(uint lamps, bool has_marks) {
    return lattice_lamp_columns(lamps) + (has_marks ? 1u : 0u);
}
LW_CONST uint first_mask_shift = 4u;
/// The column of a lamp, counted from that of the first lamps, and where the lamp's bits begin in it.
LW_INLINE uint lattice_lamp_column(uint lamp) { return lamp / lamps_per_lattice_column; }
LW_INLINE uint lattice_lamp_shift(uint lamp) { return bits_per_lattice_lamp * (lamp % lamps_per_lattice_column); }
/// The eight bits of the lamp whose bits begin at `shift` in the column `bits`.
LW_INLINE uint lattice_lamp_bits(uint bits, uint shift) { return (bits >> shift) & 0xffu; }
/// The lowest bit of each lamp of a column.
LW_CONST uint lowest_lamp_bits = 0x01010101u;
/// The lowest bits of those lamps of the column `bits` for which `mark` is set: some_visible to has_shadow_mask.
LW_INLINE uint lamps_with(uint bits, uint mark) { return (bits >> uint(findLSB(mark))) & lowest_lamp_bits; }
/// The bits of the corners that see some of a lamp, as corners_set() takes them.
LW_INLINE uint seeing_corners(uint lamp_bits) { return lamp_bits >> uint(findLSB(corner_sees)); }
/// Pixels are listed for pairs of lamps, the first or the last half of a column.
LW_CONST uint lamps_per_pair = 2u;
LW_INLINE uint ray_pairs(uint lamps) { return max((lamps + lamps_per_pair - 1u) / lamps_per_pair, 1u); }

/// Interpolates between the corners of a cell of a lattice, those of the set `bits` being 1 and the others 0. Bits 0 to
/// 3 are the corners in the order of corner_sees; `f` is the place in the cell, 0 to 1 along u and v. Returns 0 to 1.
LW_INLINE float corners_set(uint bits, vec2 f) {
    vec4 set = vec4(float(bits & 1u), float((bits >> 1) & 1u), float((bits >> 2) & 1u), float((bits >> 3) & 1u));
    return mix(mix(set.x, set.y, f.x), mix(set.z, set.w, f.x), f.y);
}

/// A shadow mask: which of 8 x 8 points of a cell of a lattice a lamp lights. Bit 8 j + i of (lit_low, lit_high) is set
/// when point (i, j) is lit; points lie at the centres of 8 x 8 squares. `tint`: the part of the light that reaches lit
/// points, RGB9E5.
struct ShadowMask {
    uint cell;  // its lower left node
    uint lamp;
    uint lit_low;
    uint lit_high;
    uint tint;
};
LW_CONST uint shadow_mask_side = 8u;
LW_CONST uint shadow_mask_rows = 4u;  // in lit_low, and in lit_high
/// The first point of every row of lit_low or lit_high.
LW_CONST uint shadow_mask_column = 0x01010101u;
/// The points of rows `first` to `last` of lit_low or lit_high, whose rows are 0 to 3; rows beyond are left out.
LW_INLINE uint shadow_mask_row_bits(int first, int last) {
    int rows = int(shadow_mask_rows);
    uint begin = uint(clamp(first, 0, rows));
    uint end = uint(clamp(last + 1, 0, rows));
    if (begin >= end) return 0u;
    return (0xffffffffu << (shadow_mask_side * begin)) & (0xffffffffu >> (shadow_mask_side * (shadow_mask_rows - end)));
}

/// Where a referenced photon lies in its grid, and which light it came from (8 bytes).
struct PhotonPlace {
    uint uv;                // 16 + 16 bits, steps of quantum.xy
    uint h_light_and_path;  // low 16: height step; high 16: light | path << 14
};

/// Specular lobes of surfaces smoother than this glTF roughness are followed by rays; see docs/decisions/0007.
LW_CONST float max_followed_roughness = 0.75f;

/// The modes of the gather.
LW_CONST uint gather_mode_exact = 0u;    // the k nearest photons, with a heap, as in the paper (docs/method.md)
LW_CONST uint gather_mode_smooth = 1u;   // bandwidth from cell counts, one pass with a smooth kernel
LW_CONST uint gather_mode_cached = 2u;   // irradiance of the lattice nodes
LW_CONST uint gather_mode_inspect = 3u;  // no light: data about the smooth estimate (shaders/inspect.glsl)

/// Least glTF roughness of a lobe that reflects photons. Photons cannot resolve a narrower lobe, so its highlight is
/// widened: it keeps its energy and loses sharpness, but has no blotches.
LW_CONST float min_gathered_roughness = 0.55f;

/// The result of a gather at a point: radiance in cd/m2 and irradiance in lux, RGB.
struct Gathered {
    vec3 radiance;
    vec3 irradiance;
    float radius;   // bandwidth, m
    float photons;  // photons under the kernel
};

/// u, v, h in metres in the frame of the grid.
LW_INLINE vec3 place_in_grid(PhotonPlace place, SurfaceGrid grid) {
    return vec3(float(place.uv & 0xffffu) * grid.quantum.x, float(place.uv >> 16) * grid.quantum.y,
                float(place.h_light_and_path & 0xffffu) * grid.quantum.z + grid.h_origin);
}

/// A point of the scene as u, v, h of the grid's frame.
LW_INLINE vec3 position_in_grid(SurfaceGrid grid, vec3 position) {
    vec3 offset = position - grid.origin;
    return vec3(dot(offset, grid.u_axis), dot(offset, grid.v_axis), dot(offset, grid.normal));
}

/// The point of the scene at u, v, h of the grid's frame.
LW_INLINE vec3 position_of(SurfaceGrid grid, vec3 local) {
    return grid.origin + local.x * grid.u_axis + local.y * grid.v_axis + local.z * grid.normal;
}

LW_INLINE uint light_of(PhotonPlace place) { return (place.h_light_and_path >> 16) & light_mask; }

LW_INLINE uint path_of(PhotonPlace place) { return place.h_light_and_path >> 30; }

/// True when a photon may lie on the same surface as the query. Its height over the query (`height`) may grow with the
/// distance, as on curved and creased surfaces; a greater height means another, parallel surface.
LW_INLINE bool on_same_surface(float height, float distance_squared, float search_radius) {
    float tolerance = 0.01f * search_radius;
    float excess = max(abs(height) - tolerance, 0.0f);
    return excess * excess <= 0.75f * distance_squared;  // slope of a 60 degree crease
}

/// Coverage of the kernel whose radius is `fraction` of the grid's, between the packed levels.
LW_INLINE float unpack_coverage(uint bits, float fraction) {
    float at = clamp(fraction * float(coverage_levels), 1.0f, float(coverage_levels)) - 1.0f;
    uint below = min(uint(at), coverage_levels - 2u);
    float low = float((bits >> (8u * below)) & 255u);
    float high = float((bits >> (8u * below + 8u)) & 255u);
    return mix(low, high, at - float(below)) / coverage_unit;
}

/// Shared-exponent RGB9E5 to float (Vulkan 1.3 specification, 'shared exponent to RGB').
LW_INLINE vec3 unpack_rgb9e5(uint bits) {
    float scale = uintBitsToFloat(((bits >> 27) + 127u - 24u) << 23);
    return vec3(float(bits & 0x1ffu), float((bits >> 9) & 0x1ffu), float((bits >> 18) & 0x1ffu)) * scale;
}

/// Nearest RGB9E5 of a colour; negative and NaN become 0, too large is clamped (Vulkan 1.3 specification, 'RGB to
/// shared exponent').
LW_INLINE uint pack_rgb9e5(vec3 color) {
    float largest = 65408.0f;  // (2^9 - 1) / 2^9 * 2^16
    vec3 c = vec3(color.x > 0.0f ? min(color.x, largest) : 0.0f, color.y > 0.0f ? min(color.y, largest) : 0.0f,
                  color.z > 0.0f ? min(color.z, largest) : 0.0f);
    float top = max(max(c.x, c.y), c.z);
    if (!(top > 0.0f)) return 0u;
    int exponent = max(-16, int(floatBitsToUint(top) >> 23) - 127) + 16;
    float scale = uintBitsToFloat(uint(127 + 24 - exponent) << 23);  // steps per unit
    if (top * scale + 0.5f >= 512.0f) {
        ++exponent;
        scale = uintBitsToFloat(uint(127 + 24 - exponent) << 23);
    }
    uint r = min(uint(c.x * scale + 0.5f), 511u);
    uint g = min(uint(c.y * scale + 0.5f), 511u);
    uint b = min(uint(c.z * scale + 0.5f), 511u);
    return r | g << 9 | b << 18 | uint(exponent) << 27;
}

/// Unit vector from 8 + 8 bits of an octahedral map (Cigolle et al. 2014), 0 to 254, which part neighbours
/// by 0.6 to 1.9 degrees. They are dithered: right in the mean of many photons.
LW_INLINE vec3 unpack_direction(uint bits) {
    float x = float(bits & 0xffu) / 127.0f - 1.0f;
    float y = float(bits >> 8) / 127.0f - 1.0f;
    float z = 1.0f - abs(x) - abs(y);
    float t = max(-z, 0.0f);
    x += x >= 0.0f ? -t : t;
    y += y >= 0.0f ? -t : t;
    return normalize(vec3(x, y, z));
}

#ifdef __cplusplus
static_assert(sizeof(SurfaceLattice) == 28 && sizeof(ShadowMask) == 20);
static_assert(sizeof(Cut) == 16 * cut_texels && offsetof(Cut, back) == 28);
static_assert(sizeof(SurfaceGrid) == 16 * surface_grid_texels && offsetof(SurfaceGrid, lattice) == 84 &&
              sizeof(PhotonPlace) == 8);
}  // namespace lw
#endif
#endif
