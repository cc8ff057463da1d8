#include "runtime/mcap/compression.h"

#include <lz4frame.h>
#include <zstd.h>

#include "runtime/mcap/bytes.h"

namespace jarol::mcap {
namespace {

void uncompress_lz4(std::string_view bytes, std::string& to) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  std::size_t read = 0, written = 0, hint = 1;
  while (hint != 0 && LZ4F_isError(hint) == 0 && read < bytes.size()) {
    std::size_t from = bytes.size() - read, room = to.size() - written;
    hint = LZ4F_decompress(context, to.data() + written, &room, bytes.data() + read, &from, nullptr);
    read += from;
    written += room;
    if (from == 0 && room == 0) break;
  }
  LZ4F_freeDecompressionContext(context);
  if (hint != 0 || read != bytes.size() || written != to.size())
    throw FormatError("a chunk that is no whole LZ4 frame");
}

}  // namespace

std::string_view name_of(Compression compression) {
  switch (compression) {
    case Compression::none: return "";
    case Compression::lz4: return "lz4";
    case Compression::zstd: return "zstd";
  }
  return "";
}

void compress(Compression compression, std::string_view bytes, std::string& to) {
  std::size_t size = 0;
  if (compression == Compression::lz4) {
    to.resize(std::max(to.size(), LZ4F_compressFrameBound(bytes.size(), nullptr)));
    size = LZ4F_compressFrame(to.data(), to.size(), bytes.data(), bytes.size(), nullptr);
    if (LZ4F_isError(size) != 0) throw std::runtime_error(LZ4F_getErrorName(size));
  } else {
    to.resize(std::max(to.size(), ZSTD_compressBound(bytes.size())));
    size = ZSTD_compress(to.data(), to.size(), bytes.data(), bytes.size(), 1);
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  }
  to.resize(size);
}

std::string uncompress(std::string_view compression, std::string_view bytes, std::uint64_t size) {
  constexpr std::uint64_t max = std::uint64_t{1} << 30;
  if (size > max) throw FormatError("a chunk of more than a gibibyte");
  if (compression.empty()) {
    if (bytes.size() != size) throw FormatError("a chunk of another size than it says");
    return std::string(bytes);
  }
  std::string to(size, '\0');
  if (compression == "lz4") {
    uncompress_lz4(bytes, to);
  } else if (compression == "zstd") {
    if (ZSTD_decompress(to.data(), to.size(), bytes.data(), bytes.size()) != size)
      throw FormatError("a chunk that is no whole Zstandard frame");
  } else {
    throw FormatError("a chunk compressed by '" + std::string(compression) + "'");
  }
  return to;
}

}  // namespace jarol::mcap
