#include "scene/json_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/replaced_file.h"

namespace lw {

nlohmann::json read_json(const std::filesystem::path& path) {
    constexpr uintmax_t most_bytes = uintmax_t(64) << 20;
    std::error_code failure;
    const bool is_file = std::filesystem::is_regular_file(path, failure);
    if (!is_file) throw Error(path.string() + ": no such file");
    if (std::filesystem::file_size(path, failure) > most_bytes) throw Error(path.string() + ": larger than 64 MiB");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error(path.string() + ": cannot be read");
    try {
        return nlohmann::json::parse(stream);
    } catch (const nlohmann::json::exception& wrong) {
        throw Error(path.string() + ": is not JSON: " + wrong.what());
    }
}

void write_json(const std::filesystem::path& path, const nlohmann::json& value) {
    ReplacedFile file(path);
    file.stream() << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    file.commit();
}

std::filesystem::path json_beside(const std::filesystem::path& scene, const std::string& what) {
    std::filesystem::path path = scene;
    return path.replace_extension("." + what + ".json");
}

}  // namespace lw
