// What the types of lights of shaders/light.h mean to a user: units, flux, usual strengths; and the text of
// shaders/lights.glsl over a Scene.
#pragma once
#include <vector>

#include "scene/surface.h"

namespace lw {

/// The unit of the intensity of a light: "cd", "lx" or "cd/m2".
const char* unit_of(LightType type);

/// The largest intensity of real lamps, in the unit of the type. A stronger one is a sign that the numbers of a scene
/// are in other units: the sun gives some 1e5 lx, lamps glow up to some 1e6 cd/m2, searchlights have some 1e7 cd.
double max_usual_intensity(LightType type);

/// Words for the way a light shines that has no photometric file.
const char* distribution_text(LightType type);

/// Radius of a sphere around the middle of the scene that contains all of it, m.
float radius_around(const Scene& scene);

/// Flux of a whole light, lm per unit intensity (per cd, lx or cd/m2). Of a light that comes_from_outside(): what
/// passes the disc around the scene. A table is summed up entry by entry, which takes milliseconds.
float unit_flux(const Scene& scene, const Light& light);

/// A direction of a distribution that has `rows` rows from pole to pole: at the part `within` of the solid angle of a
/// row.
struct ProfileDirection {
    float cosine, sine;  // to the axis
    float band;          // solid angle of the row over 2 pi
};
ProfileDirection in_profile_row(uint row, uint rows, float within);

/// The table of a light that has_table(), as cells between its entries: columns of rows, the first row at the axis. Of
/// a table of more than 131,072 entries, cells join several. flux_below[column * rows + row] is the flux of this and
/// all earlier cells, lm per cd of intensity.
struct ProfileCells {
    uint columns = 0, rows = 0;
    std::vector<float> flux_below;
};
ProfileCells cells_of_profile(const Scene& scene, const Light& light);

/// Read-only view of a Scene with the functions of shaders/lights.glsl as members, such as sample_light(light,
/// position, u). The scene must outlive it.
class LightReader : public SurfaceReader {
  public:
    explicit LightReader(const Scene& scene)
        : SurfaceReader(scene), emitters(scene.emitters.data()), scene_size(scene.size()) {}

#include "shaders/lights.glsl"

  private:
    static constexpr bool has_area_lamps = true, has_profiles = true;

    const Emitter* emitters;
    float scene_size;
};

}  // namespace lw
