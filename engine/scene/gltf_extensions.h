// Which glTF extensions the loader reads, and what it says about the others.
#pragma once
#include <string>
#include <vector>

namespace lw {

/// True when a file that requires this extension can be shown as its author meant.
bool reads_extension(const std::string& extension);

/// True when ignoring the extension may change the picture, so that the user should be told.
bool changes_look(const std::string& extension);

}  // namespace lw
