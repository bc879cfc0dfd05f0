// One room in many disguises, and its light at the same places: what must not depend on how the room is written down.
#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "maps/photon_map.h"
#include "photons/photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw::test {

using Corners = std::array<glm::dvec3, 3>;
using Soup = std::vector<Corners>;  // counter-clockwise seen from the front

/// 4 x 3 x 5 m with a block on the floor, a panel and a point lamp, before `node` places it.
struct Room {
    Soup walls, block, panel;
    double albedo = 0.5;
    double candela = 300, panel_luminance = 2000;  // cd/m2
    glm::dvec3 lamp{2.5, 2.2, 2.5}, eye{3.2, 1.6, 4.2};
    double yfov = 1.1;
    double znear = 0.01;  // m
    bool double_sided = false;
    double unit = 1;  // what a metre is in the vertices
    glm::dmat4 node{1};
};

Room plain_room();

/// A parallelogram of columns x rows cells, its front on the side of cross(u, v).
Soup quad(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, int columns = 1, int rows = 1);
/// A box; its front is outside, or inside.
Soup box(glm::dvec3 low, glm::dvec3 high, bool inside);
/// Every triangle in n x n of its shape.
Soup divided(const Soup& soup, int n);
Soup moved(Soup soup, const std::function<glm::dvec3(glm::dvec3)>& move);
Soup joined(Soup a, const Soup& b);

/// The room through the loader, from a GLB with one mesh node, one lamp node and one camera node under `node`.
Scene load(const Room& room);

struct Baked {
    Baked(const Room& room, uint64_t photon_count = 200'000, uint64_t seed = 1, bool direct_in_photons = false);
    Scene scene;
    RayCaster caster;
    Photons photons;
    PhotonMap map;
};

/// Illuminance at the surfaces that rays of the eye meet in fixed directions all around, in lux; -1 where none is met.
struct Readings {
    std::vector<double> lux;
    std::vector<glm::dvec3> places;  // from the eye, before `node`, in metres of the plain room
};
Readings read(const Baked& baked, const Room& room, uint mode);

struct Difference {
    double mean_ratio = 0, rmse = 0;  // of b against a, relative to the mean of a
    size_t compared = 0;
};
/// Prints a row of the table of hard cases (tools/hard-cases): the case, what is expected, what came out.
void tell_case(const std::string& what, const std::string& expected, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

/// Over the places that both met, to within a centimetre; `scale` is what b is divided by.
Difference difference(const Readings& a, const Readings& b, double scale = 1);

}  // namespace lw::test
