// Scenes of known answer, made of rectangles, spheres and lamps: the rooms of CIE 171:2006. All surfaces are Lambert.
#pragma once
#include "photometry/photometry.h"
#include "scene/scene.h"

namespace lw {

/// Metres, Y up. The front of a rectangle is on the side of cross(u, v).
class LabScene {
  public:
    /// A Lambert surface of this albedo and, with a radiance in cd/m2, a lamp of the same name; returns its material.
    void add_rectangle(const std::string& name, vec3 corner, vec3 u, vec3 v, float albedo, float radiance = 0);
    /// Six rectangles that face inwards, named floor, ceiling, west (-x), east, north (-z), south.
    void add_room(vec3 low, vec3 high, float albedo, float radiance = 0);
    /// A sphere seen from inside, 4 rings^2 faces; its corners lie on the radius.
    void add_sphere(vec3 centre, float radius, uint rings, float albedo);
    void add_point(vec3 position, float candela);
    void add_spot(vec3 position, vec3 direction, float candela, float inner_deg, float outer_deg);
    /// Aims along `direction`, C0 towards `across`.
    void add_luminaire(vec3 position, vec3 direction, vec3 across, const Photometry& photometry);
    void add_sun(vec3 direction, float lux);
    Scene finish();

  private:
    void begin_object(const std::string& name, float albedo, float radiance);
    void add_triangle(vec3 a, vec3 b, vec3 c);
    Light& add_light(LightType type, const std::string& name);

    Scene scene_;
};

}  // namespace lw
