#include "runtime/mcap/crc32.h"

#include <array>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace jarol::mcap {
namespace {

// tables[k][b]: what byte b does to the sum when k zero bytes follow it
constexpr auto tables = [] {
  std::array<std::array<std::uint32_t, 256>, 8> made{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t sum = b;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xedb88320U : 0U);
    made[0][b] = sum;
  }
  for (std::size_t k = 1; k < made.size(); ++k)
    for (std::size_t b = 0; b < 256; ++b) made[k][b] = (made[k - 1][b] >> 8) ^ made[0][made[k - 1][b] & 0xff];
  return made;
}();

// Eight bytes at a time; the sum as it stands in the register, not inverted.
std::uint32_t by_table(std::uint32_t sum, const char* at, std::size_t size) {
  for (; size >= 8; at += 8, size -= 8) {
    std::uint64_t word;
    std::memcpy(&word, at, sizeof word);
    word ^= sum;
    sum = 0;
    for (std::size_t k = 0; k < 8; ++k) sum ^= tables[7 - k][(word >> (8 * k)) & 0xff];
  }
  for (; size > 0; ++at, --size) sum = (sum >> 8) ^ tables[0][(sum ^ static_cast<unsigned char>(*at)) & 0xff];
  return sum;
}

// a b mod P, reflected: the top bit is 1
constexpr std::uint32_t product(std::uint32_t a, std::uint32_t b) {
  std::uint32_t sum = 0;
  for (std::uint32_t bit = 0x80000000U; bit != 0; bit >>= 1) {
    if ((a & bit) != 0) sum ^= b;
    b = (b >> 1) ^ ((b & 1) != 0 ? 0xedb88320U : 0U);
  }
  return sum;
}

#if defined(__x86_64__)
// x^n mod P, reflected and shifted up by one as carry-less multiplication of reflected words needs it.
constexpr std::uint64_t power(int n) {
  std::uint32_t value = 0x80000000U;  // 1
  for (int i = 0; i < n; ++i) value = (value >> 1) ^ ((value & 1) != 0 ? 0xedb88320U : 0U);
  return std::uint64_t{value} << 1;
}

// a moved up by as many bits as the two powers say, onto b
__attribute__((target("pclmul,sse4.1"))) inline __m128i fold(__m128i a, __m128i powers, __m128i b) {
  const __m128i low = _mm_clmulepi64_si128(a, powers, 0x00), high = _mm_clmulepi64_si128(a, powers, 0x11);
  return _mm_xor_si128(_mm_xor_si128(low, high), b);
}

// moved over so many bits
template <int Bits>
constexpr std::uint64_t low_power = power(Bits + 32);
template <int Bits>
constexpr std::uint64_t high_power = power(Bits - 32);

template <int Bits>
__attribute__((target("pclmul,sse4.1"))) inline __m128i powers_over() {
  return _mm_set_epi64x(static_cast<long long>(high_power<Bits>), static_cast<long long>(low_power<Bits>));
}

__attribute__((target("pclmul,sse4.1"))) inline __m128i load(const char* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

// Of 16 bytes that stand for all before them, and of what follows: the table does the rest.
__attribute__((target("pclmul,sse4.1"))) std::uint32_t fold_rest(__m128i a, const char* at, std::size_t size) {
  for (; size >= 16; at += 16, size -= 16) a = fold(a, powers_over<128>(), load(at));
  char folded[16];
  _mm_storeu_si128(reinterpret_cast<__m128i*>(folded), a);
  return by_table(by_table(0, folded, sizeof folded), at, size);
}

// Gopal et al., "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ" (2009): four accumulators of 16 bytes
// are folded over 64 bytes ahead, then into one; what is left has the same sum as all that was folded.
__attribute__((target("pclmul,sse4.1"))) std::uint32_t by_folding(std::uint32_t sum, const char* at, std::size_t size) {
  const __m128i over_64 = powers_over<4 * 128>(), over_16 = powers_over<128>();
  __m128i a = _mm_xor_si128(load(at), _mm_cvtsi32_si128(static_cast<int>(sum)));
  __m128i b = load(at + 16), c = load(at + 32), d = load(at + 48);
  for (at += 64, size -= 64; size >= 64; at += 64, size -= 64) {
    a = fold(a, over_64, load(at));
    b = fold(b, over_64, load(at + 16));
    c = fold(c, over_64, load(at + 32));
    d = fold(d, over_64, load(at + 48));
  }
  return fold_rest(fold(fold(fold(a, over_16, b), over_16, c), over_16, d), at, size);
}

__attribute__((target("avx2"))) inline __m256i load_wide(const char* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

__attribute__((target("vpclmulqdq,avx2"))) inline __m256i fold(__m256i a, __m256i powers, const char* b) {
  const __m256i low = _mm256_clmulepi64_epi128(a, powers, 0x00), high = _mm256_clmulepi64_epi128(a, powers, 0x11);
  return _mm256_xor_si256(_mm256_xor_si256(low, high), load_wide(b));
}

// The same with accumulators of 32 bytes, over 128 bytes ahead.
__attribute__((target("pclmul,vpclmulqdq,avx2"))) std::uint32_t by_wide_folding(std::uint32_t sum, const char* at,
                                                                                std::size_t size) {
  const __m256i over_128 = _mm256_broadcastsi128_si256(powers_over<8 * 128>());
  __m256i all[4] = {load_wide(at), load_wide(at + 32), load_wide(at + 64), load_wide(at + 96)};
  all[0] = _mm256_xor_si256(all[0], _mm256_zextsi128_si256(_mm_cvtsi32_si128(static_cast<int>(sum))));
  for (at += 128, size -= 128; size >= 128; at += 128, size -= 128)
    for (int i = 0; i < 4; ++i) all[i] = fold(all[i], over_128, at + 32 * i);
  const __m128i over_16 = powers_over<128>();
  __m128i one = _mm256_castsi256_si128(all[0]);
  for (int i = 0; i < 4; ++i) {
    if (i > 0) one = fold(one, over_16, _mm256_castsi256_si128(all[i]));
    one = fold(one, over_16, _mm256_extracti128_si256(all[i], 1));
  }
  return fold_rest(one, at, size);
}

bool can_fold() {
  static const bool can = __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("sse4.1") != 0;
  return can;
}

bool can_fold_wide() {
  static const bool can =
      can_fold() && __builtin_cpu_supports("vpclmulqdq") != 0 && __builtin_cpu_supports("avx2") != 0;
  return can;
}
#endif

}  // namespace

std::uint32_t crc32_by_table(std::string_view bytes, std::uint32_t before) {
  return ~by_table(~before, bytes.data(), bytes.size());
}

std::uint32_t crc32_by_narrow_folding(std::string_view bytes, std::uint32_t before) {
#if defined(__x86_64__)
  if (bytes.size() >= 64 && can_fold()) return ~by_folding(~before, bytes.data(), bytes.size());
#endif
  return crc32_by_table(bytes, before);
}

std::uint32_t joined_crc32(std::uint32_t first, std::uint32_t second, std::uint64_t bytes_of_second) {
  // the first one times x^(8 n)
  std::uint32_t square = 0x00800000U;  // x^8
  for (; bytes_of_second != 0; bytes_of_second >>= 1, square = product(square, square))
    if ((bytes_of_second & 1) != 0) first = product(first, square);
  return first ^ second;
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
#if defined(__x86_64__)
  if (bytes.size() >= 256 && can_fold_wide()) return ~by_wide_folding(~before, bytes.data(), bytes.size());
#endif
  return crc32_by_narrow_folding(bytes, before);
}

}  // namespace jarol::mcap
