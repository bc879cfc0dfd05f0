#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>

#include <algorithm>
#include <cassert>
#include <fstream>

#include "base/error.h"
#include "base/input_file.h"
#include "base/one_line.h"
#include "base/replaced_file.h"

namespace lw {
namespace {

constexpr int max_side = 1 << 17;
constexpr float largest_half = 65504.0f;
constexpr uint64_t max_samples = uint64_t(1) << 30;
// A picture with more samples than this is read only when its file is at least 1/4096 as large as the picture. No codec
// of OpenEXR compresses more, so a smaller file lies about its size.
constexpr uint64_t trusted_samples = uint64_t(1) << 24;

std::vector<half> to_half(const std::vector<float>& values) {
    std::vector<half> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(),
                   [](float v) { return half(std::clamp(v, -largest_half, largest_half)); });  // NaN stays NaN
    return result;
}

template <class T>
Imf::Slice plane(const Imath::Box2i& window, Imf::PixelType type, const std::vector<T>& values) {
    return Imf::Slice::Make(type, values.data(), window, sizeof(T), 0);
}

void write_channels(std::ofstream& stream, const std::string& name, const Image& image) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves;
    for (const Channel& channel : image.channels) {
        assert(channel.values.size() == image.pixel_count());
        Imf::PixelType type = channel.half ? Imf::HALF : Imf::FLOAT;
        header.channels().insert(channel.name, Imf::Channel(type));
        if (channel.half) halves.push_back(to_half(channel.values));
        buffer.insert(channel.name, channel.half ? plane(header.dataWindow(), type, halves.back())
                                                 : plane(header.dataWindow(), type, channel.values));
    }
    Imf::StdOFStream exr_stream(stream, name.c_str());
    Imf::OutputFile file(exr_stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(image.height);
}

uint64_t count_channels(const Imf::ChannelList& channels) {
    uint64_t count = 0;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            throw Error("channel \"" + std::string(c.name()) + "\" is subsampled");
        ++count;
    }
    return count;
}

/// The size of the data window, refused before memory is asked for when no honest file of `file_size` bytes has it.
Image make_image(const Imf::Header& header, uint64_t file_size) {
    const Imath::Box2i& window = header.dataWindow();
    int64_t width = int64_t(window.max.x) - window.min.x + 1;
    int64_t height = int64_t(window.max.y) - window.min.y + 1;
    std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > max_side || height > max_side) throw Error("absurd size " + size);
    uint64_t samples = uint64_t(width) * uint64_t(height) * count_channels(header.channels());
    if (samples == 0) throw Error("no channels");
    if (samples > max_samples || (samples > trusted_samples && samples / 4096 > file_size))
        throw Error("absurd size " + size + " for a file of " + std::to_string(file_size) + " bytes");
    Image image;
    image.width = int(width);
    image.height = int(height);
    return image;
}

Image read_channels(std::ifstream& stream, const std::string& name, uint64_t file_size) {
    Imf::Header::setMaxImageSize(max_side, max_side);
    Imf::StdIFStream exr_stream(stream, name.c_str());
    Imf::InputFile file(exr_stream);
    const Imf::Header& header = file.header();
    if (header.hasType() && Imf::isDeepData(header.type())) throw Error("deep data, not a flat picture");
    Image image = make_image(header, file_size);
    Imf::FrameBuffer buffer;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const std::vector<float>& values = image.add(c.name(), 0.0f, c.channel().type == Imf::HALF);
        buffer.insert(c.name(), plane(header.dataWindow(), Imf::FLOAT, values));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
    return image;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image) {
    assert(image.width > 0 && image.height > 0 && !image.channels.empty());
    ReplacedFile file(path);
    try {
        write_channels(file.stream(), path.string(), image);
    } catch (const std::exception& e) {
        throw Error(path.string() + ": cannot be written: " + one_line(e.what()));
    }
    file.commit();
}

Image read_exr(const std::filesystem::path& path) {
    std::error_code failure;
    uint64_t file_size = std::filesystem::file_size(path, failure);
    std::ifstream stream = open_input(path);
    if (failure || !stream) throw Error(path.string() + ": cannot be opened");
    try {
        return read_channels(stream, path.string(), file_size);
    } catch (const std::exception& e) {
        throw Error(path.string() + ": not a readable OpenEXR picture: " + one_line(e.what()));
    }
}

}  // namespace lw
