#include "measure/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lw {
namespace {

constexpr double normal_90 = 1.645;

Estimate ratio(Estimate above, Estimate below) {
    if (!(below.value > 0)) return {};
    const double value = above.value / below.value;
    const double of_above = above.value > 0 ? above.half_width / above.value : 0;
    return {value, value * std::hypot(of_above, below.half_width / below.value)};
}

Verdict compare(Estimate estimate, double least) {
    if (estimate.value - estimate.half_width >= least) return Verdict::pass;
    return estimate.value + estimate.half_width < least ? Verdict::fail : Verdict::undecided;
}

}  // namespace

Statistics statistics_of(std::span<const Reading> readings, std::span<const Value> values, bool sampled) {
    assert(readings.size() == values.size());
    Statistics result;
    const Value *least = nullptr, *most = nullptr;
    double sum = 0, squares = 0, ray_variance = 0, photon_error = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        if (readings[i].blocked) {
            ++result.blocked;
            continue;
        }
        const Value& value = values[i];
        ++result.count;
        result.doubtful += !value.doubt.empty();
        result.unlit += is_dark(readings[i]);
        sum += value.lux, squares += value.lux * value.lux, ray_variance += value.ray_error * value.ray_error,
            photon_error += value.photon_error;
        if (!least || value.lux < least->lux) least = &value;
        if (!most || value.lux > most->lux) most = &value;
    }
    if (!least) return result;
    const auto count = double(result.count);
    result.minimum = {least->lux, least->half_width};
    result.maximum = {most->lux, most->half_width};
    const double spread = sampled ? std::max(squares / count - sum * sum / (count * count), 0.0) / count : 0;
    const double variance = ray_variance / (count * count) + spread;
    result.average = {sum / count, normal_90 * std::hypot(std::sqrt(variance), photon_error / count)};
    result.u0 = ratio(result.minimum, result.average);
    result.ud = ratio(result.minimum, result.maximum);
    return result;
}

Judgement judge(const Statistics& statistics, const Task& task) {
    if (statistics.count == statistics.unlit) return {Verdict::undecided, Verdict::undecided};
    return {compare(statistics.average, task.illuminance), compare(statistics.u0, task.uniformity)};
}

Verdict Judgement::both() const {
    if (illuminance == Verdict::fail || uniformity == Verdict::fail) return Verdict::fail;
    return illuminance == Verdict::pass && uniformity == Verdict::pass ? Verdict::pass : Verdict::undecided;
}

std::string name_of(Verdict verdict) {
    return verdict == Verdict::pass ? "pass" : verdict == Verdict::fail ? "fail" : "undecided";
}

}  // namespace lw
