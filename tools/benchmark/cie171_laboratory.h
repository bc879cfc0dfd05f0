// What the cases of CIE 171:2006 are measured with: scenes in, results beside their formulas out, by the functions
// behind lumenwalk-measure; and the configuration factor, of which most formulas are made. Metres, Y up.
#pragma once
#include "cie171.h"
#include "measure/sensor.h"
#include "measure/survey.h"
#include "scene/scene.h"

namespace lw {

using Corners = std::vector<glm::dvec3>;

/// Configuration factor of a plane element to a polygon wholly above its horizon: Lambert's contour integral (1760).
double configuration_factor(glm::dvec3 point, glm::dvec3 normal, const Corners& polygon);

Corners rectangle(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v);

Sensor facing(vec3 position, vec3 normal, Response response = Response::planar);

/// What a case is called in the table.
struct CieCase {
    std::string section, what, formula;
};

class Laboratory {
  public:
    /// `photons` per bake.
    explicit Laboratory(uint64_t photons) : photons_(photons) {}

    /// One sensor per point; adds a result for each, with the published values where there are as many.
    void add(const CieCase& name, const Scene& scene, const std::vector<Sensor>& sensors,
             const std::vector<double>& expected, const std::vector<double>& published = {});

    /// Flux that falls on the six faces of LabScene::add_room(), lm, `area` m2 each.
    void add_flux(const CieCase& name, const Scene& scene, double area, double expected);

    /// Mean illuminance of a grid.
    void add_grid(const CieCase& name, const Scene& scene, const std::string& grid, double expected);

    /// Mean illuminance of the six faces of LabScene::add_room(), alike in size, by `count` sensors on each.
    Estimate mean_of_room(const Scene& scene, uint count) const;

    std::vector<CieResult> results;

  private:
    Survey measure(const Scene& scene, std::vector<SensorSet> sets) const;

    uint64_t photons_;
};

/// The rooms and points of the standard itself, with the values that public copies of it print.
void add_published_cases(Laboratory& lab);

}  // namespace lw
