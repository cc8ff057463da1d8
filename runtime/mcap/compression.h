// How the records of a chunk are compressed: not at all, as an LZ4 frame, or by Zstandard.
#pragma once

#include <string>
#include <string_view>

namespace jarol::mcap {

enum class Compression { none, lz4, zstd };

/// As MCAP calls it: "", "lz4", "zstd".
std::string_view name_of(Compression compression);

/// Into `to`, whose memory is used again. Throws std::runtime_error.
void compress(Compression compression, std::string_view bytes, std::string& to);

/// Bytes that are so many when they are whole. Throws FormatError.
std::string uncompress(std::string_view compression, std::string_view bytes, std::uint64_t size);

}  // namespace jarol::mcap
