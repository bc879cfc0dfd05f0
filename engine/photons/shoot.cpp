#include "photons/shoot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "photons/aim.h"
#include "trace/bsdf.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr uint64_t chunk_size = 4096;           // paths per task
constexpr uint64_t pilot_paths = 8192;          // per lamp, to learn what it stores
constexpr uint64_t aim_paths = 131072;          // per sun, to learn where its light enters
constexpr size_t most_pilot_photons = 100'000;  // of a task: enough to learn from, in a room that absorbs little
constexpr int longest_path = 1000;              // ends paths between surfaces that absorb nothing; 0.99^1000 is 4e-5
constexpr int depth_of_roulette = 64;

double luminance(vec3 c) { return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z); }

/// One task: paths [first, last) of a lamp.
struct Chunk {
    uint light;
    uint64_t first, last;
    std::vector<Photon> photons;
    double emitted_flux = 0, absorbed = 0, escaped = 0;
    uint64_t shown = 0;  // hits of surfaces that can show light
};

/// The class of a path of class `path` that goes on by `next`. Shadow rays pass where light goes straight on.
uint path_after(uint path, const Scatter& next) {
    if (!next.narrow || path == path_indirect) return path_indirect;
    if (!next.specular || path == path_near_caustic) return path_near_caustic;
    return next.straight ? path : path_caustic;
}

class Shooter {
  public:
    Shooter(const Scene& scene, const RayCaster& caster, const ShootSettings& settings)
        : caster_(caster), surfaces_(scene), emitters_(scene), aims_(scene.lights.size()), settings_(settings) {}

    void aim(uint light, Aim aim) { aims_[light] = std::move(aim); }

    /// The five emission numbers of a path, before aiming: Owen-scrambled Sobol.
    std::array<float, 5> numbers(uint light, uint64_t index) const;

    /// Traces the paths of a chunk; each photon carries 1 / emitted of the lamp's flux. Ends early with `most` photons.
    void trace(Chunk& chunk, double emitted, size_t most = std::numeric_limits<size_t>::max()) const {
        uint64_t index = chunk.first;
        for (; index < chunk.last && chunk.photons.size() < most; ++index)
            trace_path(chunk, index, float(1.0 / emitted));
        chunk.last = index;
    }

  private:
    void trace_path(Chunk& chunk, uint64_t index, float share) const;

    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::vector<Aim> aims_;
    ShootSettings settings_;
};

std::array<float, 5> Shooter::numbers(uint light, uint64_t index) const {
    const auto scramble = uint32_t(mix64(settings_.seed * 0x10001 + light));
    std::array<float, 5> u;
    for (int d = 0; d < 5; ++d) u[size_t(d)] = sobol_owen(uint32_t(index), d, scramble);
    return u;
}

void Shooter::trace_path(Chunk& chunk, uint64_t index, float share) const {
    Rng rng(settings_.seed, chunk.light + 1, index);
    std::array<float, 5> u = numbers(chunk.light, index);
    share *= aims_[chunk.light].warp(u);
    const Emission photon = emitters_.emit(chunk.light, u);
    vec3 flux = photon.flux * share, origin = caster_.offset(photon.origin, photon.normal),
         direction = photon.direction, medium(0);
    uint path = path_direct;
    chunk.emitted_flux += luminance(flux);
    for (int depth = 0; depth < longest_path; ++depth) {
        const std::optional<Hit> hit = caster_.nearest(origin, direction, rng);
        if (!hit) {
            chunk.escaped += luminance(flux);
            return;
        }
        const Surface s = surfaces_.surface_at(hit->triangle, hit->barycentrics);
        const vec3 arriving =
            flux * surfaces_.passed_by_medium(absorption_before(surfaces_, s, direction, medium), hit->distance);
        chunk.absorbed += luminance(flux) - luminance(arriving);
        flux = arriving;
        const bool back = dot(s.geometric_normal, direction) > 0;
        const bool shows_light = !surfaces_.is_purely_specular(s);
        chunk.shown += shows_light;
        if (shows_light && (path != path_direct || settings_.direct_in_photons))
            chunk.photons.push_back(
                {s.position, flux, -direction, hit->triangle, pack_origin(chunk.light, path, back)});
        const std::optional<Scatter> next = sample_bsdf(surfaces_, s, -direction, Carries::flux, rng);
        const vec3 reflected = next ? flux * next->weight : vec3(0);
        const float before = std::max({flux.x, flux.y, flux.z}),
                    after = std::max({reflected.x, reflected.y, reflected.z});
        // Ends what is caught in clear glass.
        const float longest_survival = depth < depth_of_roulette || (next && !next->specular) ? 1.0f : 0.95f;
        const float survival = before > 0 ? std::min(longest_survival, after / before) : 0.0f;
        if (!(rng.next() < survival)) {
            chunk.absorbed += luminance(flux);
            return;
        }
        const vec3 kept = reflected / survival;
        chunk.absorbed += luminance(flux) - luminance(kept);
        flux = kept;
        path = path_after(path, *next);
        const vec3 ng = back ? -s.geometric_normal : s.geometric_normal;
        direction = next->direction;
        medium = absorption_after(surfaces_, s, direction, medium);
        origin = caster_.offset(s.position, dot(direction, ng) > 0 ? ng : -ng);
    }
    chunk.absorbed += luminance(flux);
}

std::vector<Chunk> split_paths(const std::vector<uint64_t>& emitted, const std::vector<uint64_t>& first) {
    std::vector<Chunk> chunks;
    for (uint light = 0; light < emitted.size(); ++light)
        for (uint64_t i = first[light]; i < emitted[light]; i += chunk_size)
            chunks.push_back({light, i, std::min(i + chunk_size, emitted[light]), {}, 0, 0, 0});
    return chunks;
}

/// Learns from where on its disc each sun lights the scene by more than one bounce.
void aim_suns(Shooter& shooter, const Scene& scene) {
    for (uint light = 0; light < scene.lights.size(); ++light) {
        if (scene.lights[light].type != light_directional) continue;
        std::vector<double> useful_per_path(aim_paths, 0);
        parallel_for(
            aim_paths,
            [&](size_t i) {
                Chunk path{light, i, i + 1, {}, 0, 0, 0};
                shooter.trace(path, double(aim_paths));
                for (const Photon& p : path.photons)
                    useful_per_path[i] += p.path() == path_direct ? 0 : luminance(p.flux);
            },
            1024);
        std::vector<double> useful(Aim::side * Aim::side, 0);
        for (size_t i = 0; i < aim_paths; ++i) {
            const std::array<float, 5> u = shooter.numbers(light, i);
            useful[size_t(u[0] * Aim::side) * Aim::side + size_t(u[1] * Aim::side)] += useful_per_path[i];
        }
        shooter.aim(light, Aim(useful));
    }
}

/// How many paths each lamp gets so that `wanted` photons are stored in all.
std::vector<uint64_t> plan_emission(const Shooter& shooter, const Scene& scene, uint64_t wanted) {
    const size_t count = scene.lights.size();
    std::vector<Chunk> pilots = split_paths(std::vector<uint64_t>(count, pilot_paths), std::vector<uint64_t>(count, 0));
    parallel_for(pilots.size(), [&](size_t i) { shooter.trace(pilots[i], double(pilot_paths), most_pilot_photons); });
    std::vector<double> yield(count, 0), useful(count, 0), traced(count, 0);
    for (const Chunk& pilot : pilots) traced[pilot.light] += double(pilot.last - pilot.first);
    uint64_t shown = 0;
    for (const Chunk& pilot : pilots) {
        yield[pilot.light] += double(pilot.photons.size()) / traced[pilot.light];
        shown += pilot.shown;
        for (const Photon& p : pilot.photons)
            useful[pilot.light] += luminance(p.flux * scene.lights[pilot.light].intensity) *
                                   (p.path() == path_direct ? 0.05 : 1) * (double(pilot_paths) / traced[pilot.light]);
    }
    if (shown == 0)
        throw Error(scene.path.filename().string() +
                    ": no light reaches a surface that can show it; check where the lamps stand and point");
    double sum = 0;
    for (double& flux : useful) sum += flux = std::sqrt(flux);
    const double floor = sum > 0 ? 0.25 * sum / double(count) : 1;
    sum = 0;
    for (size_t light = 0; light < count; ++light)
        sum += useful[light] = yield[light] > 0 ? std::max(useful[light], floor) : 0;
    std::vector<uint64_t> emitted(count, pilot_paths);  // a lamp without yield: enough for its energy balance
    for (size_t light = 0; light < count; ++light)
        if (yield[light] > 0)
            emitted[light] = uint64_t(
                std::max(1.0, std::round(double(wanted) * useful[light] / sum / std::max(yield[light], 0.02))));
    for (uint64_t paths : emitted)
        if (paths > 0xffffffffull)
            throw Error(scene.path.filename().string() +
                        ": more than 2^32 photon paths for one lamp; ask for fewer photons");
    return emitted;
}

}  // namespace

Photons shoot_photons(const Scene& scene, const RayCaster& caster, const ShootSettings& settings) {
    if (scene.lights.size() > light_mask) throw Error(scene.path.filename().string() + ": more than 16383 lamps");
    Shooter shooter(scene, caster, settings);
    aim_suns(shooter, scene);
    const std::vector<uint64_t> emitted = plan_emission(shooter, scene, settings.photons);
    std::vector<Chunk> chunks = split_paths(emitted, std::vector<uint64_t>(emitted.size(), 0));
    uint64_t paths = 0;
    for (uint64_t n : emitted) paths += n;
    {
        Progress progress("photons", paths);
        parallel_for(chunks.size(), [&](size_t i) {
            shooter.trace(chunks[i], double(emitted[chunks[i].light]));
            progress.step(chunks[i].last - chunks[i].first);
        });
    }
    Photons photons;
    photons.lights.resize(scene.lights.size());
    std::vector<size_t> begins;
    size_t total = 0;
    for (const Chunk& chunk : chunks) {
        begins.push_back(total);
        total += chunk.photons.size();
        LightBalance& balance = photons.lights[chunk.light];
        balance.stored += chunk.photons.size();
        balance.flux_out += chunk.emitted_flux;
        balance.absorbed += chunk.absorbed;
        balance.escaped += chunk.escaped;
    }
    for (uint light = 0; light < emitted.size(); ++light) photons.lights[light].emitted = emitted[light];
    photons.records.resize(total);
    parallel_for(chunks.size(), [&](size_t i) {
        std::copy(chunks[i].photons.begin(), chunks[i].photons.end(), photons.records.begin() + ptrdiff_t(begins[i]));
        std::vector<Photon>().swap(chunks[i].photons);
    });
    return photons;
}

}  // namespace lw
