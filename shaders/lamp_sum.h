// The sum over lamps at the lattice: what its dispatches are told (gather/lamp_sum).
#ifndef LW_LAMP_SUM_H
#define LW_LAMP_SUM_H
#include "bindings.h"
#include "photon_map.h"
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST uint no_place = 0xffffffffu;  // of a lamp whose own light no cell holds, of an entry that is zero

/// What a lamp adds to the sums; of a lamp that changed, what its change adds.
struct LampTerm {
    vec3 scaled_power;  // power x scale of the sums: the factor of PhotonMap::irradiance
    uint lamp;
    vec3 power;     // RGB, in the unit of the lamp's intensity: the factor of its own light
    uint punctual;  // its place among the lamps whose own light cells may hold, or no_place
};

/// Push constants of both passes. A lattice cell has the number of its lower left node.
struct LampSumPush {
    uint first;  // node of the first invocation
    uint end;    // node after the last one
    uint nodes;  // of the lattices of all maps
    uint terms;
    uint adds;               // 1: to the sums as they are, 0: from nothing
    uint keeps_direct;       // 1: the own light of lamps in cells is kept apart, so that lamps that change can be added
    uint row_length;         // of a cell in LatticeLight::rows()
    uint first_lamp_column;  // of a row, that of the first lamps
    float record_scale;      // scale of the sums x PhotonMap::irradiance_scale
};

LW_CONST uint lamp_sum_group = 64u;
/// Nodes of one dispatch: a storage buffer that holds what is written for so many fits every device.
LW_CONST uint lamp_sum_window = 2097152u;

#ifdef __cplusplus
static_assert(sizeof(LampTerm) == 32 && sizeof(LampSumPush) == 36);
}  // namespace lw
#endif
#endif
