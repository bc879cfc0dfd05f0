#include "scene/gltf_ranges.h"

#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

namespace lw {
namespace {

using Json = nlohmann::json;
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double above_zero = std::numeric_limits<double>::min();

/// A number, or an array of numbers, that elements of one kind may have, with its allowed range.
struct Quantity {
    const char* place;  // JSON pointer
    size_t length;      // of the array; 0: a single number
    double least, most;
    bool is_refused = false;  // true: out of range is an error; false: the nearest value in range is taken
};

constexpr Quantity of_materials[] = {
    {"/pbrMetallicRoughness/baseColorFactor", 4, 0, 1},
    {"/pbrMetallicRoughness/metallicFactor", 0, 0, 1},
    {"/pbrMetallicRoughness/roughnessFactor", 0, 0, 1},
    {"/emissiveFactor", 3, 0, endless, true},
    {"/alphaCutoff", 0, 0, endless},
    {"/extensions/KHR_materials_emissive_strength/emissiveStrength", 0, 0, endless, true},
    {"/extensions/KHR_materials_specular/specularFactor", 0, 0, 1},
    {"/extensions/KHR_materials_specular/specularColorFactor", 3, 0, endless},
    {"/extensions/KHR_materials_transmission/transmissionFactor", 0, 0, 1},
    {"/extensions/KHR_materials_ior/ior", 0, -endless, endless},  // its range is checked where it is read
    {"/extensions/KHR_materials_volume/thicknessFactor", 0, -endless, endless},
    {"/extensions/KHR_materials_volume/attenuationDistance", 0, -endless, endless},
    {"/extensions/KHR_materials_volume/attenuationColor", 3, 0, 1},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", 4, 0, 1},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", 3, 0, 1},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", 0, 0, 1},
};

constexpr Quantity of_lights[] = {
    {"/intensity", 0, 0, endless, true},
    {"/color", 3, 0, endless, true},
    {"/spot/innerConeAngle", 0, 0, 1.5708},
    {"/spot/outerConeAngle", 0, 0, 1.5708},
};

constexpr Quantity of_cameras[] = {
    {"/perspective/yfov", 0, above_zero, endless, true},
    {"/perspective/yfov", 0, 0, 3.1},
    {"/perspective/aspectRatio", 0, above_zero, endless, true},
};

std::string range_of(const Quantity& q) {
    if (q.least == above_zero) return "more than 0";
    char text[64];
    std::snprintf(text, sizeof text, q.most < endless ? "from %g to %g" : "at least %g", q.least, q.most);
    return text;
}

/// The name of the quantity: the last word of its JSON pointer.
std::string name_of(const Quantity& q) { return std::string(q.place).substr(std::string(q.place).rfind('/') + 1); }

void check(GltfFile& file, const Json& element, const std::string& where, const Quantity& q) {
    const Json::json_pointer place(q.place);
    if (!element.contains(place)) return;
    const Json& value = element.at(place);
    const bool is_array = value.is_array() && value.size() == q.length;
    const Json& numbers = q.length == 0 ? Json::array({value}) : value;
    bool has_type = q.length == 0 || is_array;
    for (size_t i = 0; has_type && i < numbers.size(); ++i) has_type = numbers[i].is_number();
    if (!has_type)
        file.fail(where + ": " + name_of(q) + " must be " +
                  (q.length == 0 ? "a number" : std::to_string(q.length) + " numbers"));
    for (const Json& number : numbers) {
        const double found = number.get<double>();
        if (found >= q.least && found <= q.most) continue;
        if (q.is_refused) file.fail(where + ": " + name_of(q) + " must be " + range_of(q));
        file.warn(where + ": " + name_of(q) + " should be " + range_of(q) + "; the nearest is taken");
        return;
    }
}

template <size_t N>
void check_each(GltfFile& file, const Json& root, const char* list, const char* kind, const Quantity (&quantities)[N]) {
    const Json::json_pointer place(list);
    if (!root.contains(place) || !root.at(place).is_array()) return;
    size_t index = 0;
    for (const Json& element : root.at(place)) {
        const auto name = element.is_object() ? element.find("name") : element.end();
        const std::string where =
            label(kind, index++, name != element.end() && name->is_string() ? name->template get<std::string>() : "");
        for (const Quantity& q : quantities)
            if (element.is_object()) check(file, element, where, q);
    }
}

}  // namespace

void check_ranges(GltfFile& file, const Json& root) {
    check_each(file, root, "/materials", "material", of_materials);
    check_each(file, root, "/extensions/KHR_lights_punctual/lights", "light", of_lights);
    check_each(file, root, "/cameras", "camera", of_cameras);
}

}  // namespace lw
