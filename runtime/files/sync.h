// What is written stays, also if the power goes.
#pragma once

#include <cstdio>
#include <filesystem>

namespace jarol {

/// Flushes and syncs a file, where that is one that can be; whether all went out, else errno says why.
bool sync(std::FILE* file);

/// The names in the folder of that file.
void sync_folder_of(const std::filesystem::path& path);

}  // namespace jarol
