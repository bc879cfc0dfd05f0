// A picture of named float channels, as an OpenEXR file holds it. Row 0 is the top.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace lw {

/// One plane of width x height floats; integer channels (triangle ids) are kept as exact floats below 2^24.
struct Channel {
    std::string name;  // "R", "G", "B", "depth", "normal.X", "illuminance", "error.R", ...
    std::vector<float> values;
    bool half = false;  // stored with 16 bits in EXR
};

struct Image {
    int width = 0;
    int height = 0;
    std::vector<Channel> channels;

    size_t pixel_count() const { return size_t(width) * size_t(height); }
    /// The channel of this name, or nullptr.
    const Channel* find(const std::string& name) const {
        for (const Channel& c : channels)
            if (c.name == name) return &c;
        return nullptr;
    }
    /// Appends a channel filled with `value` and returns its samples.
    std::vector<float>& add(const std::string& name, float value = 0.0f, bool half = false) {
        channels.push_back({name, std::vector<float>(pixel_count(), value), half});
        return channels.back().values;
    }
};

}  // namespace lw
