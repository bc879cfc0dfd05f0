// binding_NAME for every row of the table.
#ifndef LW_BINDINGS_H
#define LW_BINDINGS_H
#include "types.h"
#ifdef __cplusplus
namespace lw {
#endif
#define LW_BINDING(set, name, type, count, stages) LW_CONST uint binding_##name = uint(__LINE__);
#include "binding_table.h"
#undef LW_BINDING
#ifdef __cplusplus
}  // namespace lw
#endif
#endif
