// Rooms made for measuring: 10 x 3 x 8 m with boxes, spheres and tori, of any number of triangles and lamps.
#pragma once
#include "scene/scene.h"

namespace lw {

enum class Tessellation {
    uniform,  // triangles of one size everywhere
    mixed     // walls and boxes of two triangles a face, all others in the spheres and tori
};

enum class Finish {
    lambert,   // no specular lobe anywhere
    glossy,    // dielectric lobes of roughness 0.4 on every surface
    textured,  // Lambert, with a base colour texture on the shell of the room
    glass      // Lambert, the sculptures of clear glass
};

/// Which lamps hang from the ceiling; together they send 20,000 lm whatever their number.
enum class Lamps { panels, points, alternating };

struct RoomSettings {
    size_t triangles = 100'000;  // about; the least is 72 and two per panel
    unsigned lights = 2;
    Lamps lamps = Lamps::alternating;  // a panel of 0.6 m, a point, a panel ...
    Tessellation tessellation = Tessellation::mixed;
    Finish finish = Finish::lambert;
};

/// The room, with one camera "corner". Deterministic.
Scene make_room(const RoomSettings& settings);

const char* name_of(Tessellation tessellation);

}  // namespace lw
