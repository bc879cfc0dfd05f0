// The specialization constants of the view pass, as frame_constants.h. Some devices run both sides of a branch.
// A row that is broken has two lines, and compilers differ in which of them counts.
// clang-format off
LW_CONSTANT(uint, shown_view, view_shaded)
LW_CONSTANT(uint, shown_curve, curve_neutral)
LW_CONSTANT(bool, has_lines, true)
LW_CONSTANT(bool, has_split, true)
LW_CONSTANT(bool, is_scaled, true)     // picture and screen differ in size
LW_CONSTANT(bool, is_readback, false)  // an invocation per pixel of the readback instead of per pixel of the screen
