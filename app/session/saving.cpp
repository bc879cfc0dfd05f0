#include "app/session/saving.h"

#include <cstdio>

#include "app/session/actions.h"
#include "base/error.h"
#include "photometry/photometry.h"

namespace lw {
namespace {

/// Loads with `load`; what is wrong is told and remembered, so that the file is not overwritten.
template <class Value, class Load>
Value loaded_or_empty(const Load& load, std::string& trouble) {
    try {
        return load();
    } catch (const Error& failure) {
        trouble = failure.what();
        std::fprintf(stderr, "warning: %s\n", trouble.c_str());
        return {};
    }
}

}  // namespace

Session open_session(const World& world, std::filesystem::path output) {
    Session s(world, std::move(output));
    const std::filesystem::path& scene = world.scene.path;
    s.lighting.presets = loaded_or_empty<LampPresets>([&] { return load_lamp_presets(default_ambiances_path(scene)); },
                                                      s.lighting.presets_error);
    s.bookmarks = loaded_or_empty<std::vector<Bookmark>>([&] { return load_bookmarks(default_bookmarks_path(scene)); },
                                                         s.bookmarks_error);
    return s;
}

void save_presets(Session& s, const std::string& what) {
    const std::filesystem::path path = default_ambiances_path(s.world.scene.path);
    if (!s.lighting.presets_error.empty()) {
        tell(s, s.lighting.presets_error + "; put it right or move it away");
        return;
    }
    try {
        save_lamp_presets(path, s.lighting.presets);
        tell(s, what + " saved in " + path.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void attach_file(Session& s, size_t lamp, const std::string& file) {
    const std::string& name = s.world.scene.light_names[lamp];
    try {
        if (!file.empty()) read_photometry(s.world.scene.path.parent_path() / file);
    } catch (const Error& failure) {
        return tell(s, failure.what(), 8);
    }
    if (file.empty())
        s.lighting.presets.photometry.erase(name);
    else
        s.lighting.presets.photometry[name] = file;
    save_presets(s, "light distribution of \"" + name + "\"");
    s.reload = true;
}

void add_bookmark(Session& s) {
    if (!s.bookmarks_error.empty()) {
        tell(s, s.bookmarks_error + "; put it right or move it away");
        return;
    }
    const std::string name = "bookmark " + std::to_string(s.bookmarks.size() + 1);
    s.bookmarks.push_back(bookmark_of(name, s.walker, s.yfov, s.world.scene));
    const std::filesystem::path path = default_bookmarks_path(s.world.scene.path);
    try {
        save_bookmarks(path, s.bookmarks);
        tell(s, name + " saved in " + path.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void toggle_recording(Session& s) {
    if (!s.recording) {
        start_recording(s);
        tell(s, "recording the walk; R ends it");
        return;
    }
    const Path path = *s.recording;
    s.recording.reset();
    try {
        const std::filesystem::path file = free_name(s, "path.json");
        save_path(file, path);
        tell(s, "walk saved: lumenwalk --play " + file.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

std::filesystem::path free_name(const Session& s, const std::string& extension) {
    const std::string stem = s.world.scene.path.stem().string();
    for (int i = 1;; ++i) {
        char number[16];
        std::snprintf(number, sizeof number, "-%03d.", i);
        const std::filesystem::path path = s.output / (stem + number + extension);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace lw
