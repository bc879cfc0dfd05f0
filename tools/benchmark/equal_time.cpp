// The path tracer at the time of the gather's frame, and at its error.
#include <cmath>

#include "accuracy.h"
#include "base/progress.h"
#include "rooms.h"
#include "scene/camera.h"
#include "scene/gltf.h"
#include "sections.h"
#include "trace/reference.h"

namespace lw {
namespace {

struct Subject {
    std::string name;
    Scene scene;
    std::string camera;
    uint width, height;
    uint64_t reference_samples;
};

/// Measured noise of the path tracer: error = at_one_second / sqrt(seconds).
struct Convergence {
    double error_at_one_second = 0;
    double seconds_per_sample = 0;  // one path per pixel
    double error_in(double seconds) const { return error_at_one_second / std::sqrt(seconds); }
    double seconds_to(double error) const { return std::pow(error_at_one_second / error, 2); }
};

/// Runs of the path tracer draw other numbers than the reference.
Reference trace(const BakedCase& baked, const ReferenceView& view, uint64_t samples) {
    ReferenceSettings settings;
    settings.width = int(view.width), settings.height = int(view.height);
    settings.samples = samples;
    settings.illuminance = false;
    settings.seed = 2;
    return render_reference(baked.scene, *baked.caster, view.camera, baked.powers, settings);
}

struct TracerRun {
    double seconds = 0;
    FrameError error;
};

TracerRun run_tracer(const BakedCase& baked, const ReferenceView& view, const Image& reference, uint64_t samples) {
    Reference traced;
    TracerRun run;
    run.seconds = cost_of([&] { traced = trace(baked, view, samples); }).seconds;
    run.error = error_of(traced.image, reference, Quantity::luminance);
    return run;
}

/// Geometric mean of error x sqrt(seconds) over the runs.
Convergence convergence_of(const std::vector<TracerRun>& runs, const std::vector<uint64_t>& samples) {
    double logarithm = 0, seconds = 0, paths = 0;
    for (size_t i = 0; i < runs.size(); ++i) {
        logarithm += std::log(runs[i].error.rmse_without_noise * std::sqrt(runs[i].seconds)) / double(runs.size());
        seconds += runs[i].seconds, paths += double(samples[i]);
    }
    return {std::exp(logarithm), seconds / paths};
}

Row tracer_row(const std::string& scene, const std::string& what, double ms, double samples) {
    return {{"scene", scene}, {"method", what}, {"ms", ms}, {"samples_per_pixel", samples}};
}

/// Rows of one scene: the gather, the path tracer's runs, equal time, equal error.
std::vector<Row> measure_subject(const Bench& bench, Subject subject) {
    const uint width = subject.width, height = subject.height;
    BakeSettings bake;
    bake.photons = bench.pick<uint64_t>(500'000, 4'000'000);
    const BakedCase baked(std::move(subject.scene), bake, bench.folder);
    const ReferenceView view{find_camera(baked.scene, subject.camera), width, height, subject.reference_samples};
    const Image reference = cached_reference(bench.folder, baked.scene, *baked.caster, view);
    const TimedFrame frame =
        CaseOnDevice(bench.device, baked).render(view.camera, {width, height, 3}, GatherSettings{});
    const FrameError gather_error = error_of(frame.rendering.image, reference, Quantity::luminance);

    std::vector<Row> rows{tracer_row(subject.name, "gather", frame.total_ms(), 0)};
    add_error(rows.back(), gather_error);
    const std::vector<uint64_t> ladder =
        bench.quick ? std::vector<uint64_t>{1, 4, 16} : std::vector<uint64_t>{4, 16, 64};
    std::vector<TracerRun> runs;
    for (uint64_t samples : ladder) {
        runs.push_back(run_tracer(baked, view, reference, samples));
        rows.push_back(tracer_row(subject.name, "path tracer", 1e3 * runs.back().seconds, double(samples)));
        add_error(rows.back(), runs.back().error);
    }
    const Convergence tracer = convergence_of(runs, ladder);

    const double equal_s = 1e-3 * frame.total_ms();
    rows.push_back(
        tracer_row(subject.name, "path tracer, equal time (fit)", 1e3 * equal_s, equal_s / tracer.seconds_per_sample));
    rows.back()["rmse_%"] = 100 * tracer.error_in(equal_s);
    const double needed_s = tracer.seconds_to(gather_error.rmse_without_noise);
    const auto needed = uint64_t(std::max(1.0, std::round(needed_s / tracer.seconds_per_sample)));
    rows.push_back(tracer_row(subject.name, "path tracer, equal error (fit)", 1e3 * needed_s,
                              needed_s / tracer.seconds_per_sample));
    rows.back()["rmse_%"] = 100 * gather_error.rmse_without_noise;
    rows.back()["times_the_gather"] = needed_s / equal_s;
    if (needed_s > bench.pick(20.0, 600.0)) return rows;
    const TracerRun check = run_tracer(baked, view, reference, needed);
    rows.push_back(tracer_row(subject.name, "path tracer, equal error (run)", 1e3 * check.seconds, double(needed)));
    add_error(rows.back(), check.error);
    rows.back()["times_the_gather"] = check.seconds / equal_s;
    return rows;
}

}  // namespace

std::vector<Table> measure_equal_time(const Bench& bench) {
    Table table{
        "equal-time",
        "rows",
        "The picture's luminance: the default gather (all passes) and the path tracer on the CPU, without its "
        "illuminance channel. *fit*: from error = c / sqrt(time) through the runs; a fraction of a sample means "
        "that equal time does not reach every pixel.",
        {}};
    std::vector<Subject> subjects;
    const uint side = bench.pick(128u, 500u);
    subjects.push_back({"room", make_room({}), "", side, side, bench.pick<uint64_t>(64, 512)});
    subjects.push_back({"apartment.glb", load_gltf(bench.scenes / "apartment.glb"), "living", bench.pick(160u, 320u),
                        bench.pick(90u, 180u), bench.pick<uint64_t>(64, 1024)});
    for (Subject& subject : subjects)
        for (Row& row : measure_subject(bench, std::move(subject))) table.rows.push_back(std::move(row));
    return {table};
}

}  // namespace lw
