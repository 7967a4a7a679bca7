#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "aplomb/core/error.h"

namespace aplomb {

/// Told the absolute path of the temporary file just before it is made, and an empty path once it is gone (renamed or
/// removed). A program that handles signals copies the path into a plain buffer and unlink()s it in its handler.
using TempFileListener = std::function<void(const std::filesystem::path& temp_or_empty)>;

/// Writes a whole file so that the target is always old or complete: beside it, fsync, rename.
/// Follows a symbolic link (what it points to is replaced, the link stays), keeps an existing file's permissions, and
/// writes straight into what is not a regular file (a pipe, /dev/null). "-" is standard output. Temporary files of runs
/// that were killed, an hour old, are removed from the folder.
///
/// \return file_system naming the file and the reason (missing or read-only folder, a directory, full disk); then
///         neither the target nor the folder has changed.
Result<void> write_file_atomically(const std::filesystem::path& target, std::span<const std::byte> bytes,
                                   const TempFileListener& on_temp_file = {});

}  // namespace aplomb
