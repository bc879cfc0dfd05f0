// Text as files hold it -- with marks of byte order, in UTF-16, with line ends of any system -- as plain lines.
#pragma once
#include <filesystem>
#include <string>

namespace lw {

/// The text in UTF-8 without a mark of byte order, each line ended by LF: CR, CR LF and LF end lines in `bytes`, which
/// are UTF-16 where they begin with its mark and taken as they are otherwise.
std::string plain_text(const std::string& bytes);

/// The bytes of a file. Throws Error when it cannot be opened or has more than 16 MB.
std::string read_text_file(const std::filesystem::path& path);

/// The file of this name in `folder`, whatever the case of its letters and whatever folders `name` begins with; ""
/// when there is none.
std::filesystem::path file_in_folder(const std::filesystem::path& folder, const std::string& name);

/// The text with A to Z for a to z.
std::string upper_case(std::string text);

}  // namespace lw
