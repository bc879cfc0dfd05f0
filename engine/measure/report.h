// A survey as one self-contained HTML page: tables per ambiance and per lamp, plans with false colours and isolux
// lines, camera views in false colours.
#pragma once
#include <string>
#include <vector>

#include "measure/survey.h"
#include "trace/ray_caster.h"

namespace lw {

/// `cameras`: names of cameras of the scene to show in false colours. Throws Error for an unknown one.
std::string report_as_html(const Survey& survey, const Scene& scene, const RayCaster& caster,
                           const std::vector<std::string>& cameras);

}  // namespace lw
