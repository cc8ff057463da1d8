#include "graph/plugins/plugin.h"

namespace {
using jarol::describe, jarol::field, jarol::Enumerator, jarol::Tick;

enum class Gear : std::uint8_t { neutral, drive };
[[maybe_unused]] constexpr auto enumerators(Gear) {
  return std::array<Enumerator<Gear>, 2>{{{"neutral", Gear::neutral, "the motor is off"}, {"drive", Gear::drive}}};
}

struct Place {
  double north = 0, east = 0;
  static constexpr auto fields() { return describe(field<&Place::north>("m"), field<&Place::east>("m")); }
};

struct FieldTypes {
  static constexpr std::string_view summary = "has a field of each type, and does nothing";
  struct Param {
    double gain = 0.5;
    float coarse = 2;
    bool enabled = true;
    std::int32_t steps = 3;
    std::chrono::nanoseconds patience{500'000'000};
    Gear gear = Gear::neutral;
    std::array<double, 2> limits{-1, 1};
    Eigen::Vector3d axis{0, 0, 1};
    Place start;
    jarol::Sequence<double> weights{};
    jarol::Sequence<Place> track{};
    jarol::String label{};
    static constexpr auto fields() {
      return describe(field<&Param::gain>("1/s", "what a double is"), field<&Param::coarse>(), field<&Param::enabled>(),
                      field<&Param::steps>(), field<&Param::patience>(), field<&Param::gear>(),
                      field<&Param::limits>("rad"), field<&Param::axis>(), field<&Param::start>(),
                      field<&Param::weights>(), field<&Param::track>(), field<&Param::label>());
    }
  };
  struct Out {
    double gain = 0;
    static constexpr auto fields() { return describe(field<&Out::gain>("1/s")); }
  };
  static void run(const Param& p, const Tick&, Out& out) { out.gain = p.gain; }
};
}  // namespace

JAROL_PLUGIN(FieldTypes)
