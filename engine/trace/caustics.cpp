#include "trace/caustics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "shaders/color.h"
#include "shaders/kernel.h"
#include "trace/bsdf.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint64_t paths_per_task = 4096;
constexpr int max_bounces = 64;
constexpr float roughest_caster = 0.35f;  // a lobe at this roughness is some 15 degrees wide
constexpr float min_alignment = 0.8f;     // least cosine between normals at an arrival and at the estimate's point

/// True for polished metal and glass. `s` is a Surface or a Material.
bool is_polished(const auto& s) {
    return s.roughness < roughest_caster && (s.metallic > 0.999f || s.transmission > 0.999f) &&
           (s.flags & material_unlit) == 0;
}

/// Traces paths from lamps for as long as they meet surfaces that cast caustics.
class CausticPath {
  public:
    CausticPath(const Scene& scene, const RayCaster& caster) : caster_(caster), surfaces_(scene), emitters_(scene) {}

    const Emitters& emitters() const { return emitters_; }

    void trace(const Emission& emission, vec3 weight, Rng& rng, std::vector<Caustics::Arrival>& arrivals) const {
        vec3 flux = emission.flux * weight, origin = caster_.offset(emission.origin, emission.normal),
             direction = emission.direction, medium(0);
        bool direct = true;
        std::vector<Hit> passed;  // blended surfaces that the path went through; they are lit too
        for (int bounce = 0; bounce < max_bounces; ++bounce) {
            passed.clear();
            const std::optional<Hit> hit = caster_.nearest(origin, direction, rng, &passed);
            if (!direct)
                for (const Hit& blend : passed) {
                    const Surface s = surfaces_.surface_at(blend.triangle, blend.barycentrics);
                    arrive(s, flux * surfaces_.passed_by_medium(medium, blend.distance), direction, arrivals);
                }
            if (!hit) return;
            const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
            flux *= surfaces_.passed_by_medium(absorption_before(surfaces_, s, direction, medium), hit->distance);
            if (!direct) arrive(s, flux, direction, arrivals);
            const std::optional<Scatter> next = sample_bsdf(surfaces_, s, -direction, Carries::flux, rng);
            if (!next || !(next->specular || casts_caustics(s))) return;
            flux *= next->weight;
            direct = direct && next->straight;
            direction = next->direction;
            medium = absorption_after(surfaces_, s, direction, medium);
            const vec3 ng = s.geometric_normal;
            origin = caster_.offset(s.position, dot(direction, ng) > 0 ? ng : -ng);
        }
    }

  private:
    void arrive(const Surface& s, vec3 flux, vec3 direction, std::vector<Caustics::Arrival>& arrivals) const {
        const vec3 ng = s.geometric_normal * (dot(s.geometric_normal, direction) > 0 ? -1.0f : 1.0f);
        if (!casts_caustics(s)) arrivals.push_back({s.position, flux, -direction, ng});
    }

    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
};

/// The number of paths of each lamp and, last, of the sun, about as many in all as the settings ask for: half for the
/// sun, which would leave none to the lamps by its flux, the others in proportion to the flux.
std::vector<uint64_t> share_paths(const CausticPath& path, const Scene& scene, std::span<const vec3> powers,
                                  const CausticSettings& settings) {
    std::vector<double> flux;
    for (uint i = 0; i < scene.lights.size(); ++i)
        flux.push_back(precise_luminance(powers[i]) * double(path.emitters().unit_flux(i)));
    double sum = std::accumulate(flux.begin(), flux.end(), 0.0);
    if (settings.sky && settings.sky->has_sun()) {
        flux.push_back(sum > 0 ? sum : 1);
        sum += flux.back();
    }
    std::vector<uint64_t> paths(flux.size(), 0);
    for (size_t i = 0; i < flux.size(); ++i)
        if (flux[i] > 0) paths[i] = 1 + uint64_t(double(settings.paths) * flux[i] / sum);
    return paths;
}

}  // namespace

bool casts_caustics(const Surface& s) { return is_polished(s); }

bool has_caustics(const Scene& scene, std::span<const vec3> powers, const SkySampler* sky) {
    const auto is_specular = [](const Material& m) {
        const bool varies = m.metallic_roughness_texture.texture >= 0 || m.transmission_texture.texture >= 0;
        const bool smooth = varies || m.roughness * m.roughness < min_alpha;
        return is_polished(m) || (smooth && (m.metallic > 0 || m.specular > 0 || m.transmission > 0));
    };
    if (std::none_of(scene.materials.begin(), scene.materials.end(), is_specular)) return false;
    if (sky && sky->has_sun()) return true;
    return std::any_of(powers.begin(), powers.end(), [](vec3 weight) { return precise_luminance(weight) > 0; });
}

Caustics::Caustics(const Scene& scene, const RayCaster& caster, std::span<const vec3> powers,
                   const CausticSettings& settings)
    : radius_(settings.radius) {
    struct Task {
        uint light;  // its index; of the sun the number of lamps
        uint64_t first, last, of;
        std::vector<Arrival> arrivals;
    };
    const CausticPath path(scene, caster);
    const std::vector<uint64_t> paths = share_paths(path, scene, powers, settings);
    std::vector<Task> tasks;
    for (uint light = 0; light < paths.size(); ++light)
        for (uint64_t i = 0; i < paths[light]; i += paths_per_task)
            tasks.push_back({light, i, std::min(i + paths_per_task, paths[light]), paths[light], {}});
    const auto scramble = uint32_t(mix64(settings.seed * 0x10001 + settings.set));
    parallel_for(tasks.size(), [&](size_t t) {
        Task& task = tasks[t];
        const bool is_sun = task.light == scene.lights.size();
        const vec3 weight = (is_sun ? vec3(1) : powers[task.light]) / float(task.of);
        for (uint64_t i = task.first; i < task.last; ++i) {
            Rng rng(settings.seed ^ 0xca05, (settings.set << 14) + task.light, i);
            std::array<float, 5> numbers;
            for (int d = 0; d < 5; ++d) numbers[size_t(d)] = sobol_owen(uint32_t(i), d, scramble + task.light);
            path.trace(is_sun ? settings.sky->emit_from_sun(numbers) : path.emitters().emit(task.light, numbers),
                       weight, rng, task.arrivals);
        }
    });
    std::vector<Arrival> all;
    for (const Task& task : tasks) all.insert(all.end(), task.arrivals.begin(), task.arrivals.end());
    cell_starts_.assign(std::max<size_t>(all.size(), 1) + 1, 0);
    for (const Arrival& a : all) ++cell_starts_[cell_of(a.position) + 1];
    for (size_t c = 1; c < cell_starts_.size(); ++c) cell_starts_[c] += cell_starts_[c - 1];
    std::vector<uint> next(cell_starts_.begin(), cell_starts_.end() - 1);
    arrivals_.resize(all.size());
    for (const Arrival& a : all) arrivals_[next[cell_of(a.position)]++] = a;
}

uint Caustics::cell_of(vec3 position) const {
    uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
        hash = mix64(hash ^ uint64_t(int64_t(std::floor(double(position[axis]) / (2.0 * double(radius_))))));
    return uint(hash % (cell_starts_.size() - 1));
}

/// Calls visit(arrival, kernel in 1/m2) for all arrivals within the radius on a surface of like orientation.
template <class Visit>
void Caustics::visit_near(vec3 point, vec3 normal, const Visit& visit) const {
    if (arrivals_.empty()) return;
    const float r2 = radius_ * radius_;
    std::array<uint, 8> cells;
    for (uint corner = 0; corner < 8; ++corner)
        cells[corner] = cell_of(point + radius_ * vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    std::sort(cells.begin(), cells.end());
    const auto end = std::unique(cells.begin(), cells.end());
    for (auto cell = cells.begin(); cell != end; ++cell)
        for (uint i = cell_starts_[*cell]; i < cell_starts_[*cell + 1]; ++i) {
            const vec3 d = arrivals_[i].position - point;
            const float d2 = dot(d, d);
            if (d2 < r2 && dot(arrivals_[i].normal, normal) > min_alignment)
                visit(arrivals_[i], kernel_peak(r2) * kernel_shape(d2 / r2));
        }
}

vec3 Caustics::irradiance(vec3 point, vec3 normal) const {
    vec3 sum(0);
    visit_near(point, normal, [&](const Arrival& a, float kernel) { sum += a.flux * kernel; });
    return sum;
}

vec3 Caustics::reflected(const SurfaceReader& reader, const Surface& s, vec3 n, vec3 ng, vec3 to_view) const {
    vec3 sum(0);
    if (casts_caustics(s)) return sum;
    const auto add = [&](const Arrival& a, float kernel) {
        const float tilt = std::abs(dot(n, a.from)) / std::max(std::abs(dot(ng, a.from)), 0.05f);
        sum += reader.eval_bsdf(s, n, to_view, a.from) * a.flux * (kernel * std::min(tilt, 2.0f));
    };
    visit_near(s.position, ng, add);
    if (s.transmission > 0) visit_near(s.position, -ng, add);  // through a rough sheet
    return sum;
}

}  // namespace lw
