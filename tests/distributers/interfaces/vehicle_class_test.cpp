// What a vehicle of another's may be wrong in, and what is said of it.
#include "distributers/interfaces/vehicle_class.h"

#include <doctest/doctest.h>

#include <cmath>

#include "distributers/messages/javiator.h"
#include "graph/text/errors.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;
using vehicles::Range;

struct Truth {
  double depth = 0;
  static constexpr auto fields() { return describe(field<&Truth::depth>("m")); }
};
struct Speed {
  double speed = 0;
  static constexpr auto fields() { return describe(field<&Speed::speed>("m/s")); }
};
struct Outputs {
  Truth gauge;
  static constexpr auto fields() { return describe(field<&Outputs::gauge>()); }
};
struct Parameters {
  std::int32_t grid = 10;  // ms
  bool throws_number = false, throws_error = false, no_type = false, other_type = false, no_truth = false,
       no_outputs = false;
  static constexpr auto fields() {
    using P = Parameters;
    return describe(field<&P::grid>(), field<&P::throws_number>(), field<&P::throws_error>(), field<&P::no_type>(),
                    field<&P::other_type>(), field<&P::no_truth>(), field<&P::no_outputs>());
  }
};

struct Pair {
  double left = 0, right = 0;
  static constexpr auto fields() { return describe(field<&Pair::left>(), field<&Pair::right>()); }
};

template <class In>
class Diver : public vehicles::Vehicle {
 public:
  using Parameters = ::Parameters;
  using Inputs = In;
  using Outputs = ::Outputs;
  using Truth = ::Truth;
  explicit Diver(const Parameters& parameters, std::uint64_t) : is_(parameters) {
    if (is_.throws_number) throw 5;
    if (is_.throws_error) throw std::logic_error("it is too deep");
  }
  std::chrono::nanoseconds grid() const override { return std::chrono::milliseconds(is_.grid); }
  void accept(messages::MessageRef) override {}
  void step() override {}
  void sense(messages::Receiver&) const override {}
  const Type* true_type() const override {
    return is_.no_type ? nullptr : is_.other_type ? &type_of<Speed>() : &type_of<Truth>();
  }
  const void* true_values() const override { return is_.no_truth ? nullptr : &truth_; }
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return is_.no_outputs ? nullptr : &outputs_; }

 private:
  Parameters is_;
  Truth truth_;
  Outputs outputs_;
};

// as many ranges as it says, the last of them from 2 to `end`
template <int count, int end>
struct Ranged {
  double left = 0, right = 0;
  static constexpr auto fields() { return describe(field<&Ranged::left>(), field<&Ranged::right>()); }
  static std::vector<Range> ranges() {
    std::vector<Range> all(count, {2, 3});
    if (count > 0) all.back().max = end == 0 ? std::nan("") : end;
    return all;
  }
};
struct Float {
  double left = 0;
  float right = 0;
  static constexpr auto fields() { return describe(field<&Float::left>(), field<&Float::right>()); }
  static std::vector<Range> ranges() { return {{-1, 1}, {-1, 1}}; }
};
struct Flag {
  bool on = false;
  static constexpr auto fields() { return describe(field<&Flag::on>()); }
  static std::vector<Range> ranges() { return {{0, 1}}; }
};
struct Good {
  Pair motors;
  std::array<double, 2> fins{};
  static constexpr auto fields() { return describe(field<&Good::motors>(), field<&Good::fins>()); }
  static std::vector<Range> ranges() { return std::vector<Range>(4, {-1, 1}); }
};

template <class In>
vehicles::VehicleClass diver() {
  return vehicles::vehicle_class<Diver<In>>("diver", messages::javiator::message_set(), "dives");
}

template <class In>
std::string error_of() {
  try {
    diver<In>();
  } catch (const InputError& error) { return error.what(); }
  return "";
}

std::string error_of(const Parameters& parameters) {
  try {
    diver<Good>().make(&parameters, 0);
  } catch (const std::exception& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("distributers/interfaces/vehicle_class") {
  TEST_CASE("each input is a double and has its range") {
    CHECK(error_of<Good>() == "");
    CHECK(error_of<Ranged<0, 3>>() ==
          "vehicle 'diver' has another number of ranges (0) than of inputs (2); Inputs::ranges() gives one for each, "
          "in their order");
    CHECK(error_of<Ranged<200, 3>>() ==
          "vehicle 'diver' has another number of ranges (200) than of inputs (2); Inputs::ranges() gives one for "
          "each, in their order");
    CHECK(error_of<Ranged<2, -2>>() ==
          "vehicle 'diver' has an input 'right' from 2 to -2; Inputs::ranges() gives the smaller end first");
    CHECK(error_of<Ranged<2, 0>>() ==
          "vehicle 'diver' has an input 'right' from 2 to nan; Inputs::ranges() gives the smaller end first");
    CHECK(error_of<Float>() == "vehicle 'diver' has an input 'right' of type float; an input is a double");
    CHECK(error_of<Flag>() == "vehicle 'diver' has an input 'on' of type bool; an input is a double");
  }

  TEST_CASE("a vehicle is looked at when it is made") {
    CHECK(error_of(Parameters{}) == "");
    CHECK(error_of(Parameters{.grid = 0}) == "its grid() is 0ns; a step has a length above zero, as in 10ms");
    CHECK(error_of(Parameters{.grid = -10}) == "its grid() is -10ms; a step has a length above zero, as in 10ms");
    CHECK(error_of(Parameters{.throws_number = true}) == "its constructor throws what is no std::exception");
    CHECK(error_of(Parameters{.throws_error = true}) == "it is too deep");
    const std::string type = "its true_type() is not that of its Truth; it returns &jarol::type_of<Truth>()";
    CHECK(error_of(Parameters{.no_type = true}) == type);
    CHECK(error_of(Parameters{.other_type = true}) == type);
    CHECK(error_of(Parameters{.no_truth = true}) == "its true_values() is null; it returns the address of its Truth");
    CHECK(error_of(Parameters{.no_outputs = true}) == "its outputs() is null; it returns the address of its Outputs");
  }
}
