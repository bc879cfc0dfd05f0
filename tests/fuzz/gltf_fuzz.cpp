// libFuzzer target of the glTF loader. Half of the mutations are of bytes; the others bend a member of the JSON, which
// bytes alone rarely leave well formed.
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "fuzz/feed.h"

namespace {

using Json = nlohmann::json;

const Json odd_values[] = {nullptr,
                           -1,
                           0,
                           1,
                           2,
                           5120,
                           5126,
                           65536,
                           1000000000,
                           4294967295u,
                           9223372036854775807ll,
                           1e300,
                           -1e300,
                           1e-320,
                           0.5,
                           "",
                           "data:,",
                           "data:image/png;base64,iVBORw0KGgo=",
                           "SCALAR",
                           "MAT4",
                           "BLEND",
                           Json::array(),
                           Json::object(),
                           Json::array({0, 0, 0}),
                           true};

/// All containers of the document that have members.
void collect(Json& value, std::vector<Json*>& containers) {
    if (!value.is_structured()) return;
    if (!value.empty()) containers.push_back(&value);
    for (Json& member : value) collect(member, containers);
}

void bend(Json& root, std::mt19937& random) {
    std::vector<Json*> containers;
    collect(root, containers);
    if (containers.empty()) return;
    const auto pick = [&](size_t count) { return size_t(random()) % count; };
    Json& container = *containers[pick(containers.size())];
    auto member = std::next(container.begin(), ptrdiff_t(pick(container.size())));
    switch (pick(5)) {
        case 0:
            container.erase(member);
            break;
        case 1:
            *member = Json(*containers[pick(containers.size())]);
            break;
        case 2:
            if (container.is_array()) container.push_back(Json(*member));
            break;
        case 3:
            if (member->is_number()) {
                *member = member->get<double>() + double(pick(3)) - 1;
                break;
            }
            [[fallthrough]];
        default:
            *member = odd_values[pick(std::size(odd_values))];
    }
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* bytes, size_t size, size_t most);

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t most, unsigned seed) {
    std::mt19937 random(seed);
    Json root;
    if (random() % 2) root = Json::parse(bytes, bytes + size, nullptr, false);
    if (!root.is_object() || root.empty()) return LLVMFuzzerMutate(bytes, size, most);
    for (unsigned i = 0; i <= random() % 3; ++i) bend(root, random);
    const std::string text = root.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (text.size() > most) return LLVMFuzzerMutate(bytes, size, most);
    std::copy(text.begin(), text.end(), bytes);
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    lw::test::feed_gltf({bytes, size});
    return 0;
}
