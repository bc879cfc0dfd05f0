// The compiled shaders against the tables of their specialization constants and bindings.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "compact.comp.spv.h"
#include "cull.comp.spv.h"
#include "gather.comp.spv.h"
#include "gather/bindings.h"
#include "gather/constants.h"
#include "gather_queries.comp.spv.h"
#include "scan.comp.spv.h"
#include "size_lists.comp.spv.h"
#include "sum_cells.comp.spv.h"
#include "sum_nodes.comp.spv.h"
#include "tonemap.comp.spv.h"
#include "view.comp.spv.h"
#include "visibility.frag.spv.h"
#include "visibility.vert.spv.h"

namespace lw {
namespace {

using Type = vk::DescriptorType;

/// A shader, and the tables it is written by.
struct Shader {
    const char* name;
    SpirV code;
    std::vector<BindingSet> sets;  // entry i: descriptor set i
    bool of_view = false;          // its constants are those of ViewConstants
};

const Shader shaders[] = {
    {"gather.comp", gather_comp, {BindingSet::scene, BindingSet::picture}},
    {"gather_queries.comp", gather_queries_comp, {BindingSet::scene, BindingSet::picture}},
    {"size_lists.comp", size_lists_comp, {BindingSet::scene, BindingSet::picture}},
    {"tonemap.comp", tonemap_comp, {BindingSet::scene, BindingSet::picture}},
    {"cull.comp", cull_comp, {BindingSet::scene, BindingSet::cull}},
    {"scan.comp", scan_comp, {BindingSet::scene, BindingSet::cull}},
    {"compact.comp", compact_comp, {BindingSet::scene, BindingSet::cull}},
    {"visibility.vert", visibility_vert, {BindingSet::scene, BindingSet::cull}},
    {"visibility.frag", visibility_frag, {BindingSet::scene, BindingSet::cull}},
    {"view.comp", view_comp, {BindingSet::view}, true},
    {"sum_nodes.comp", sum_nodes_comp, {BindingSet::lamp_sum}},
    {"sum_cells.comp", sum_cells_comp, {BindingSet::lamp_sum}},
};

/// What a SPIR-V module says of one of its ids (SPIR-V specification, section 3.32: the opcodes below).
struct Id {
    std::string name;
    std::map<uint32_t, uint32_t> decorations;
    std::vector<uint32_t> definition;  // the whole instruction
};
constexpr uint32_t op_name = 5, op_decorate = 71, op_type_image = 25, op_type_array = 28, op_type_struct = 30,
                   op_type_pointer = 32, op_constant = 43, op_spec_true = 48, op_spec_false = 49, op_spec_constant = 50,
                   op_variable = 59, op_type_acceleration = 5341;
constexpr uint32_t spec_id = 1, binding = 33, descriptor_set = 34, dim_buffer = 5;

std::map<uint32_t, Id> ids_of(SpirV code) {
    std::map<uint32_t, Id> ids;
    const std::set<uint32_t> types{op_type_image, op_type_array, op_type_struct, op_type_pointer, op_type_acceleration};
    const std::set<uint32_t> values{op_constant, op_spec_true, op_spec_false, op_spec_constant, op_variable};
    for (size_t at = 5; at < code.size(); at += code[at] >> 16) {
        const std::vector<uint32_t> words(code.begin() + long(at), code.begin() + long(at + (code[at] >> 16)));
        const uint32_t op = words[0] & 0xffff;
        if (op == op_name) ids[words[1]].name = reinterpret_cast<const char*>(&words[2]);
        if (op == op_decorate && words.size() > 3) ids[words[1]].decorations[words[2]] = words[3];
        if (types.contains(op)) ids[words[1]].definition = words;
        if (values.contains(op)) ids[words[2]].definition = words;
    }
    return ids;
}

uint32_t op_of(const Id& id) { return id.definition.at(0) & 0xffff; }

/// The descriptors that a variable stands for.
Binding declared_by(std::map<uint32_t, Id>& ids, const Id& variable) {
    Binding result{variable.decorations.at(binding)};
    const Id* type = &ids[ids[variable.definition[1]].definition[3]];  // of what the variable's type points to
    if (op_of(*type) == op_type_array) {
        result.count = ids[type->definition[3]].definition[3];
        type = &ids[type->definition[2]];
    }
    if (op_of(*type) == op_type_acceleration) result.type = Type::eAccelerationStructureKHR;
    if (op_of(*type) == op_type_image)
        result.type = type->definition[3] == dim_buffer ? Type::eUniformTexelBuffer : Type::eSampledImage;
    return result;
}

TEST(ShaderTables, ShadersDeclareTheBindingsOfTheTable) {
    for (const Shader& shader : shaders) {
        std::map<uint32_t, Id> ids = ids_of(shader.code);
        std::set<uint32_t> seen;
        for (const auto& [number, id] : ids) {
            if (!id.decorations.contains(descriptor_set)) continue;
            SCOPED_TRACE(std::string(shader.name) + ": " + id.name);
            const Binding declared = declared_by(ids, id);
            EXPECT_TRUE(seen.insert(declared.binding).second) << "binding " << declared.binding << " twice";
            ASSERT_LT(id.decorations.at(descriptor_set), shader.sets.size());
            bool found = false;
            for (const Binding& row : bindings_of(shader.sets[id.decorations.at(descriptor_set)]))
                found |= row.binding == declared.binding && row.count == declared.count &&
                         (row.type == declared.type ||  // windows of a buffer are buffers to a shader
                          (row.type == Type::eStorageBufferDynamic && declared.type == Type::eStorageBuffer));
            EXPECT_TRUE(found) << "no row of the table is binding " << declared.binding << " of that set and type";
        }
        EXPECT_FALSE(seen.empty()) << shader.name;
    }
}

#define LW_CONSTANT(type, name, value) {__LINE__, #name},
const std::map<uint32_t, std::string> frame_constants = {
#include "shaders/frame_constants.h"
};
const std::map<uint32_t, std::string> view_constants = {
#include "shaders/view_constants.h"
};
#undef LW_CONSTANT

TEST(ShaderTables, ShadersDeclareTheConstantsOfTheTable) {
    for (const Shader& shader : shaders) {
        const auto& table = shader.of_view ? view_constants : frame_constants;
        for (const auto& [number, id] : ids_of(shader.code)) {
            if (!id.decorations.contains(spec_id)) continue;
            const auto row = table.find(id.decorations.at(spec_id));
            ASSERT_TRUE(row != table.end()) << shader.name << ": " << id.name;
            EXPECT_EQ(row->second, id.name) << shader.name;
        }
    }
}

TEST(ShaderTables, DefaultsOfTheStructsAreThoseOfTheShaders) {
    for (const Shader& shader : shaders) {
        std::map<uint32_t, uint32_t> defaults;
        for (const SpecConstant& c :
             shader.of_view ? spec_constants_of(ViewConstants()) : spec_constants_of(FrameConstants()))
            defaults[c.id] = c.bits;
        for (const auto& [number, id] : ids_of(shader.code)) {
            if (!id.decorations.contains(spec_id)) continue;
            const uint32_t bits = op_of(id) == op_spec_constant ? id.definition[3] : op_of(id) == op_spec_true;
            EXPECT_EQ(defaults.at(id.decorations.at(spec_id)), bits) << shader.name << ": " << id.name;
        }
    }
}

}  // namespace
}  // namespace lw
