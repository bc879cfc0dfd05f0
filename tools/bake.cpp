// lumenwalk-bake: photons of a glTF building into its photon map file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include "base/error.h"
#include "base/memory.h"
#include "base/one_line.h"
#include "base/parallel.h"
#include "base/program.h"
#include "base/replaced_file.h"
#include "file/map_file.h"
#include "maps/bake.h"
#include "maps/bake_memory.h"
#include "photons/shoot.h"
#include "scene/load_scene.h"
#include "shared_options.h"

namespace {

using Clock = std::chrono::steady_clock;

struct Options {
    std::string scene, output, radius = "auto", direct = "exact";
    uint64_t photons = 1'000'000, seed = 1;
    std::vector<std::string> photometry;
    float neighbour_angle_deg = 60;
    unsigned threads = 0;
    double memory_gb = 0;
};

/// Seconds since the last call, of the clock and of all processor cores, printed with the name of the phase that ended.
class PhaseClock {
  public:
    void finish(const char* phase) {
        const Clock::time_point now = Clock::now();
        const std::clock_t cpu = std::clock();
        std::printf("  %-12s %7.2f s  %7.2f CPU s\n", phase, std::chrono::duration<double>(now - last_).count(),
                    double(cpu - last_cpu_) / CLOCKS_PER_SEC);
        last_ = now, last_cpu_ = cpu;
    }

  private:
    Clock::time_point last_ = Clock::now();
    std::clock_t last_cpu_ = std::clock();
};

/// Metres, 0 for auto, nothing when the text is neither.
std::optional<float> parse_radius(const std::string& text) {
    if (text == "auto") return 0.0f;
    float radius = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, radius);
    const bool valid = result.ec == std::errc() && result.ptr == end && radius > 0 && std::isfinite(radius);
    return valid ? std::optional(radius) : std::nullopt;
}

/// What is wrong with the text of --radius, or "".
std::string misuse_of_radius(const std::string& text) {
    return parse_radius(text) ? "" : "give a positive number of metres, or auto";
}

void print_lights(const lw::Scene& scene, const std::vector<lw::LightBalance>& lights) {
    std::printf("%-24s %12s %12s %14s %14s %14s %10s\n", "lamp (unit power)", "emitted", "stored", "flux out lm",
                "absorbed lm", "escaped lm", "balance");
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const lw::LightBalance& b = lights[i];
        const double missing = b.flux_out > 0 ? (b.absorbed + b.escaped) / b.flux_out - 1 : 0;
        std::printf("%-24s %12llu %12llu %14.6g %14.6g %14.6g %+9.1e\n", scene.light_names[i].c_str(),
                    (unsigned long long)b.emitted, (unsigned long long)b.stored, b.flux_out, b.absorbed, b.escaped,
                    missing);
        if (b.stored == 0) std::printf("  warning: no photon of %s met a surface\n", scene.light_names[i].c_str());
    }
}

void print_map(const lw::PhotonMap& map, size_t triangles) {
    const uint64_t bytes = map.bytes();
    float least = 1e30f, largest = 0;
    for (const lw::SurfaceGrid& grid : map.grids)
        least = std::min(least, grid.radius), largest = std::max(largest, grid.radius);
    std::printf("%zu triangles, %zu grids, %zu nodes, radius %.2g to %.2g m, %.3f references per photon\n", triangles,
                map.grids.size(), map.coverage.size(), double(std::min(least, largest)), double(largest),
                double(map.places.size()) / double(std::max<uint64_t>(map.stored_photons, 1)));
    if (map.caustic_grids > 0)
        std::printf(
            "%u of the grids hold caustics, with %zu references\n", map.caustic_grids,
            map.places.size() - size_t(map.cell_starts[map.grids[map.grids.size() - map.caustic_grids].first_cell]));
    std::printf("map %.1f MB (%.1f bytes per stored photon), peak memory %.0f MB\n", double(bytes) / 1e6,
                double(bytes) / double(std::max<uint64_t>(map.stored_photons, 1)), double(lw::peak_memory()) / 1048576);
}

void bake(const Options& options) {
    const lw::ThreadLimit limit(options.threads);
    const lw::BakeSettings settings{.photons = options.photons,
                                    .radius = *parse_radius(options.radius),
                                    .neighbour_angle_deg = options.neighbour_angle_deg,
                                    .seed = options.seed,
                                    .direct_in_photons = options.direct == "photons"};
    const std::filesystem::path output =
        options.output.empty() ? lw::default_map_path(options.scene) : std::filesystem::path(options.output);
    PhaseClock clock;
    const lw::Scene scene = lw::load_scene(options.scene, options.photometry);
    for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    lw::check_can_create(output, scene.files);
    clock.finish("load");
    const lw::RayCaster caster(scene);
    lw::check_bake_fits(scene, caster, settings,
                        options.memory_gb > 0 ? uint64_t(options.memory_gb * 1e9) : lw::available_memory());
    clock.finish("hierarchy");
    std::vector<lw::LightBalance> lights;
    const lw::PhotonMap map = lw::bake(scene, caster, settings, [&](const lw::Photons& photons) {
        clock.finish("trace");
        lights = photons.lights;
    });
    clock.finish("maps");
    lw::save_photon_map(output, map);
    clock.finish("write");
    print_lights(scene, lights);
    print_map(map, scene.triangles.size());
    std::printf("wrote %s\n", lw::one_line(output.string()).c_str());
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Traces the photons of a glTF building and writes its photon map (unit power per lamp)."};
    app.add_option("scene", options.scene, "glTF 2.0 file, .gltf or .glb")->required();
    app.add_option("-o,--output", options.output, "photon map to write; default: SCENE.pmap beside the scene");
    app.add_option("--photons", options.photons, "photons to store")
        ->capture_default_str()
        ->check(CLI::Range(uint64_t(1), uint64_t(2'000'000'000)));
    app.add_option("--radius", options.radius,
                   "metres, the largest distance from which photons count at a point, or auto: what the "
                   "surroundings of each surface need")
        ->capture_default_str()
        ->check(misuse_of_radius);
    app.add_option("--neighbour-angle", options.neighbour_angle_deg,
                   "degrees, the largest angle between the surface of a photon and one that the photon counts on")
        ->capture_default_str()
        ->check(lw::finite_number(0, 89));
    app.add_option(
           "--direct", options.direct,
           "direct light of lamps. exact: by formulas and shadow rays when a picture is drawn, with true shadows; "
           "photons: kept as photons like reflected light, as Graglia, Sequeira and Mavromatis (2012) do, with "
           "blurred shadows and no rays")
        ->capture_default_str()
        ->check(CLI::IsMember({"exact", "photons"}));
    lw::add_seed(app, options.seed);
    lw::add_photometry(app, options.photometry);
    lw::add_threads(app, options.threads);
    app.add_option(
           "--memory", options.memory_gb,
           "GB of memory the bake may take, more is refused at the start; default: what the machine has available")
        ->check(lw::finite_number(1e-3, 1e6));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) ? 2 : 0;
    }
    return lw::run_program("lumenwalk-bake", [&] { bake(options); });
}
