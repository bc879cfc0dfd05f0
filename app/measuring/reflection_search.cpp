#include "app/measuring/reflection_search.h"

#include <algorithm>

namespace lw {
namespace {

constexpr double still_seconds = 0.4;
constexpr uint columns = 240;  // of the pixels looked at
constexpr uint samples = 8;

}  // namespace

ReflectionSearch::~ReflectionSearch() {
    if (thread_.joinable()) thread_.join();
}

const ReflectionReport* ReflectionSearch::report(const ReflectionView& view, double now) {
    if (view != seen_) seen_ = view, changed_ = now;
    if (running_) return nullptr;
    if (thread_.joinable()) thread_.join();
    if (found_ && asked_ == view) return &*found_;
    if (now - changed_ < still_seconds || view.size.x == 0) return nullptr;
    asked_ = view;
    running_ = true;
    thread_ = std::thread([this] { search(); });
    return nullptr;
}

void ReflectionSearch::search() {
    Camera camera;
    camera.position = asked_.position, camera.rotation = asked_.rotation, camera.yfov = asked_.yfov;
    ReflectionSettings settings;
    settings.width = int(columns);
    settings.height = int(std::max(1u, columns * asked_.size.y / asked_.size.x));
    settings.samples = samples;
    found_ = find_reflections(scene_, caster_, camera, asked_.powers, settings);
    running_ = false;
}

}  // namespace lw
