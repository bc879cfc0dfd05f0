#include "photons/shoot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "photons/photon_tracer.h"
#include "shaders/color.h"

namespace lw {
namespace {

constexpr uint64_t chunk_size = 1024;  // paths per task
constexpr size_t chunks_at_once = 128;
constexpr uint64_t pilot_paths = 8192;         // per lamp, to learn what it stores
constexpr uint64_t guide_paths = 131072;       // per sun, to learn where its light enters
constexpr size_t max_pilot_photons = 100'000;  // of a task of the pilot, for rooms that absorb little
std::vector<Chunk> split_paths(const std::vector<uint64_t>& emitted, const std::vector<uint64_t>& first) {
    std::vector<Chunk> chunks;
    for (uint light = 0; light < emitted.size(); ++light)
        for (uint64_t i = first[light]; i < emitted[light]; i += chunk_size)
            chunks.push_back({light, i, std::min(i + chunk_size, emitted[light]), {}, 0, 0, 0});
    return chunks;
}

/// For each sun: learns from which places of its disc light reaches the scene's surfaces after a bounce, and gives the
/// tracer a guide to them.
void guide_suns(PhotonTracer& tracer, const Scene& scene) {
    for (uint light = 0; light < scene.lights.size(); ++light) {
        if (scene.lights[light].type != light_directional) continue;
        std::vector<double> useful_per_path(guide_paths, 0);
        parallel_for(
            guide_paths,
            [&](size_t i) {
                Chunk path{light, i, i + 1, {}, 0, 0, 0};
                tracer.trace(path, double(guide_paths));
                for (const Photon& p : path.photons)
                    useful_per_path[i] += p.path() == path_direct ? 0 : precise_luminance(p.flux);
            },
            1024);
        std::vector<double> useful(EmissionGuide::side * EmissionGuide::side, 0);
        for (size_t i = 0; i < guide_paths; ++i) {
            const std::array<float, 5> u = tracer.numbers(light, i);
            useful[size_t(u[0] * EmissionGuide::side) * EmissionGuide::side + size_t(u[1] * EmissionGuide::side)] +=
                useful_per_path[i];
        }
        tracer.guide(light, EmissionGuide(useful));
    }
}

/// The number of paths of each lamp with which about `wanted` photons are stored in all, from a pilot run.
std::vector<uint64_t> plan_emission(const PhotonTracer& tracer, const Scene& scene, uint64_t wanted) {
    const size_t count = scene.lights.size();
    std::vector<Chunk> pilots = split_paths(std::vector<uint64_t>(count, pilot_paths), std::vector<uint64_t>(count, 0));
    parallel_for(pilots.size(), [&](size_t i) { tracer.trace(pilots[i], double(pilot_paths), max_pilot_photons); });
    std::vector<double> yield(count, 0), useful(count, 0), traced(count, 0);
    for (const Chunk& pilot : pilots) traced[pilot.light] += double(pilot.last - pilot.first);
    uint64_t shown = 0;
    for (const Chunk& pilot : pilots) {
        yield[pilot.light] += double(pilot.photons.size()) / traced[pilot.light];
        shown += pilot.shown;
        for (const Photon& p : pilot.photons)
            useful[pilot.light] += precise_luminance(p.flux * scene.lights[pilot.light].intensity) *
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
    std::vector<uint64_t> emitted(
        count, pilot_paths);  // a lamp whose pilot stored nothing keeps this many, for its energy balance
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

void add_to(LightBalance& balance, const Chunk& chunk) {
    balance.stored += chunk.photons.size();
    balance.flux_out += chunk.emitted_flux;
    balance.absorbed += chunk.absorbed;
    balance.escaped += chunk.escaped;
}

/// Appends the photons of some tasks, sorted by triangle, so that later steps find the photons of a surface side by
/// side in memory. A counting sort with at most 65,536 buckets; in large scenes several triangles share one.
void append_by_triangle(std::span<const Chunk> chunks, size_t triangles, std::vector<Photon>& records) {
    constexpr size_t max_buckets = 65536;
    const size_t per_bucket = triangles / max_buckets + 1;
    std::vector<size_t> next(triangles / per_bucket + 2, 0);
    for (const Chunk& chunk : chunks)
        for (const Photon& photon : chunk.photons) ++next[photon.triangle / per_bucket + 1];
    next[0] = records.size();
    std::partial_sum(next.begin(), next.end(), next.begin());
    records.resize(next.back());
    for (const Chunk& chunk : chunks)
        for (const Photon& photon : chunk.photons) records[next[photon.triangle / per_bucket]++] = photon;
}

/// Collects the photons of batches of tasks. While one batch is traced, the photons of the batch before are appended.
/// The buffers of the tasks are reused, because fresh memory costs time.
class PhotonCollector {
  public:
    PhotonCollector(const PhotonTracer& tracer, size_t triangles, Photons& photons, Progress& progress)
        : tracer_(tracer), triangles_(triangles), photons_(photons), progress_(progress) {}

    void trace(std::span<Chunk> batch) {
        parallel_for(batch.size() + 1, [&](size_t i) {
            if (i == 0) return append();
            Chunk& chunk = batch[i - 1];
            chunk.photons.swap(buffers_[i - 1]);
            tracer_.trace(chunk, double(photons_.lights[chunk.light].emitted));
            progress_.step(chunk.photons.size());
        });
        traced_ = batch;
        buffers_.swap(appended_);
    }

    void append() {
        append_by_triangle(traced_, triangles_, photons_.records);
        for (size_t i = 0; i < traced_.size(); ++i) {
            add_to(photons_.lights[traced_[i].light], traced_[i]);
            traced_[i].photons.clear();
            traced_[i].photons.swap(appended_[i]);
        }
        traced_ = {};
    }

  private:
    const PhotonTracer& tracer_;
    size_t triangles_;
    Photons& photons_;
    Progress& progress_;
    std::span<Chunk> traced_;
    using Buffers = std::vector<std::vector<Photon>>;
    Buffers buffers_ = Buffers(chunks_at_once), appended_ = Buffers(chunks_at_once);
};

}  // namespace

Photons shoot_photons(const Scene& scene, const RayCaster& caster, const ShootSettings& settings) {
    if (scene.lights.size() > light_mask) throw Error(scene.path.filename().string() + ": more than 16383 lamps");
    PhotonTracer tracer(scene, caster, settings);
    guide_suns(tracer, scene);
    const std::vector<uint64_t> emitted = plan_emission(tracer, scene, settings.photons);
    std::vector<Chunk> chunks = split_paths(emitted, std::vector<uint64_t>(emitted.size(), 0));
    Photons photons;
    photons.lights.resize(scene.lights.size());
    for (uint light = 0; light < emitted.size(); ++light) photons.lights[light].emitted = emitted[light];
    photons.records.reserve(size_t(1.02 * double(settings.photons)));  // about what comes; more is no error
    Progress progress("photons", settings.photons);
    PhotonCollector collector(tracer, scene.triangles.size(), photons, progress);
    for (size_t first = 0; first < chunks.size(); first += chunks_at_once)
        collector.trace(std::span(chunks).subspan(first, std::min(chunks_at_once, chunks.size() - first)));
    collector.append();
    return photons;
}

}  // namespace lw
