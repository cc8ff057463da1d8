#include "graph/values/digest.h"

#include <doctest/doctest.h>

#include "graph/values/type_of.h"

TEST_SUITE("graph/values/digest") {
  using namespace jarol;

  TEST_CASE("the keys are the outputs of splitmix64 from seed 0") {
    // the first outputs as published with the generator's reference code
    CHECK(digest::key(0) == 0xe220a8397b1dcdafULL);
    CHECK(digest::key(1) == 0x6e789e6aa1b965f4ULL);
    CHECK(digest::key(2) == 0x06c45d188009454fULL);
    CHECK(digest::key(3) == 0xf88bb8a8724c81ecULL);
  }

  TEST_CASE("fold is the low half xor the high half of the product of 128 bits") {
    CHECK(digest::fold(3, 5) == 15);
    CHECK(digest::fold(0xffffffffffffffffULL, 0xffffffffffffffffULL) == (1ULL ^ 0xfffffffffffffffeULL));
  }

  TEST_CASE("a name is hashed by XXH64 with seed 0") {
    CHECK(digest::name_hash("") == 0xef46db3751d8e999ULL);
    CHECK(digest::name_hash("a") == 0xd24ec4f1a98c6e5bULL);
  }

  TEST_CASE("words beyond the table of keys are hashed like the others") {
    digest::Words words;
    std::uint64_t expected = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      words.add(i);
      expected += digest::fold(i ^ digest::key(2 * i + 4), digest::key(2 * i + 5));
    }
    CHECK(words.sum() == expected);
  }

  struct Mixed {
    double d = 1.5;
    float f = -2.0F;
    std::int16_t i = -3;
    bool b = true;
    std::array<std::uint8_t, 2> a{7, 8};
    static constexpr auto fields() {
      return describe(field<&Mixed::d>(), field<&Mixed::f>(), field<&Mixed::i>(), field<&Mixed::b>(),
                      field<&Mixed::a>());
    }
  };

  TEST_CASE("the words of a value follow its description") {
    const Mixed value;
    digest::Words words;
    words.add(0x3ff8000000000000ULL);  // the bits of 1.5
    words.add(0xc0000000ULL);          // the 32 bits of -2 as a float
    words.add(0xfffffffffffffffdULL);  // -3 in two's complement
    words.add(1);
    words.add(7);
    words.add(8);
    CHECK(type_of<Mixed>().hash_words(&value) == words.sum());
  }
}
