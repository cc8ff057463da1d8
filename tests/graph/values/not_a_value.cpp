// What does not compile as a value, 24 to 30 as a task; NOT_A_VALUE says which, 0 is one that does.
#include "graph/plugins/plugin.h"

namespace {
using jarol::describe, jarol::field;

#if NOT_A_VALUE == 1  // a pointer
struct Value {
  const double* number = nullptr;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 2   // a reference
struct Value {
  double& number;
  static constexpr auto fields() { return describe(); }
};
#elif NOT_A_VALUE == 3   // a member that is not described
struct Value {
  double number = 0;
  double forgotten = 0;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 4   // a member without a description of its own
struct Inner {
  double number = 0;
};
struct Value {
  Inner inner{};
  static constexpr auto fields() { return describe(field<&Value::inner>()); }
};
#elif NOT_A_VALUE == 5   // a field twice
struct Value {
  double number = 0;
  double other = 0;
  static constexpr auto fields() { return describe(field<&Value::number>(), field<&Value::number>()); }
};
#elif NOT_A_VALUE == 6   // fields in another order
struct Value {
  double number = 0;
  double other = 0;
  static constexpr auto fields() { return describe(field<&Value::other>(), field<&Value::number>()); }
};
#elif NOT_A_VALUE == 7   // one field too many
struct Value {
  double number = 0;
  double other = 0;
  static constexpr auto fields() {
    return describe(field<&Value::number>(), field<&Value::other>(), field<&Value::other>());
  }
};
#elif NOT_A_VALUE == 8   // a vector of the standard library
struct Value {
  std::vector<double> numbers;
  static constexpr auto fields() { return describe(field<&Value::numbers>()); }
};
#elif NOT_A_VALUE == 9   // a string of the standard library
struct Value {
  std::string text;
  static constexpr auto fields() { return describe(field<&Value::text>()); }
};
#elif NOT_A_VALUE == 10  // what may be or not be
struct Value {
  std::optional<double> number;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 11  // an enumeration without names
enum class Mode { on, off };
struct Value {
  Mode mode = Mode::on;
  static constexpr auto fields() { return describe(field<&Value::mode>()); }
};
#elif NOT_A_VALUE == 12  // a range of what is no number
struct Value {
  bool number = false;
  static constexpr auto fields() { return describe(field<&Value::number>().in(0, 1)); }
};
#elif NOT_A_VALUE == 13  // a range that ends below its begin
struct Value {
  double number = 0;
  static constexpr auto fields() { return describe(field<&Value::number>().in(1, -1)); }
};
#elif NOT_A_VALUE == 14  // a range of whole numbers with a fraction
struct Value {
  std::int32_t number = 0;
  static constexpr auto fields() { return describe(field<&Value::number>().in(0, 2.5)); }
};
#elif NOT_A_VALUE == 15  // a range without end
struct Value {
  double number = 0;
  static constexpr auto fields() {
    return describe(field<&Value::number>().in(0, std::numeric_limits<double>::infinity()));
  }
};
#elif NOT_A_VALUE == 16  // a default outside of its range
struct Value {
  double number = 3;
  static constexpr auto fields() { return describe(field<&Value::number>().in(0, 1)); }
};
#elif NOT_A_VALUE == 17  // a member in the middle that is not described
struct Value {
  double number = 0;
  double forgotten = 0;
  double other = 0;
  static constexpr auto fields() { return describe(field<&Value::number>(), field<&Value::other>()); }
};
#elif NOT_A_VALUE == 18  // pointers in an array
struct Value {
  std::array<double*, 2> numbers{};
  static constexpr auto fields() { return describe(field<&Value::numbers>()); }
};
#elif NOT_A_VALUE == 19  // strings of the standard library in a sequence
struct Value {
  jarol::Sequence<std::string> texts;
  static constexpr auto fields() { return describe(field<&Value::texts>()); }
};
#elif NOT_A_VALUE == 20  // an array of C
struct Value {
  double numbers[3]{};
  static constexpr auto fields() { return describe(field<&Value::numbers>()); }
};
#elif NOT_A_VALUE == 21  // a vector with a range
struct Value {
  std::vector<double> numbers;
  static constexpr auto fields() { return describe(field<&Value::numbers>("m").in(0, 1)); }
};
#elif NOT_A_VALUE == 22  // a number whose sign the platform decides
struct Value {
  char letter = 0;
  static constexpr auto fields() { return describe(field<&Value::letter>()); }
};
#elif NOT_A_VALUE == 23  // a matrix of changing size
struct Value {
  Eigen::MatrixXd numbers;
  static constexpr auto fields() { return describe(field<&Value::numbers>()); }
};
#elif NOT_A_VALUE == 31  // a number whose size the platform decides
struct Value {
  wchar_t letter = 0;
  static constexpr auto fields() { return describe(field<&Value::letter>()); }
};
#elif NOT_A_VALUE == 32  // a part of a text
struct Value {
  std::array<char8_t, 4> letters{};
  static constexpr auto fields() { return describe(field<&Value::letters>()); }
};
#elif NOT_A_VALUE == 33  // a number of 128 bits
struct Value {
  __int128 number = 0;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 34  // a duration in other ticks
struct Value {
  std::chrono::milliseconds time{};
  static constexpr auto fields() { return describe(field<&Value::time>()); }
};
#elif NOT_A_VALUE == 35  // two enumerators by one name
enum class Mode { on, off };
constexpr auto enumerators(Mode) {
  return std::array<jarol::Enumerator<Mode>, 2>{{{"on", Mode::on}, {"on", Mode::off}}};
}
struct Value {
  Mode mode = Mode::on;
  static constexpr auto fields() { return describe(field<&Value::mode>()); }
};
#elif NOT_A_VALUE == 36  // an enumeration of nothing
enum class Mode {};
constexpr auto enumerators(Mode) { return std::array<jarol::Enumerator<Mode>, 0>{}; }
struct Value {
  Mode mode{};
  static constexpr auto fields() { return describe(field<&Value::mode>()); }
};
#elif NOT_A_VALUE == 37  // more members than there may be
struct Value {
  double a0{}, a1{}, a2{}, a3{}, a4{}, a5{}, a6{}, a7{}, a8{}, a9{}, b0{}, b1{}, b2{}, b3{}, b4{}, b5{}, b6{}, b7{},
      b8{}, b9{}, c0{}, c1{}, c2{}, c3{}, c4{}, c5{}, c6{}, c7{}, c8{}, c9{}, d0{}, d1{}, d2{};
  static constexpr auto fields() { return describe(field<&Value::a0>()); }
};
#elif NOT_A_VALUE == 39  // without fields()
struct Value {
  double number = 0;
};
#else                    // a value; the names of an enumeration within it can only stand behind it
struct Value {
  enum class Mode { on, off };
  double number = 0;
  Mode mode = Mode::on;
  static constexpr auto fields() { return describe(field<&Value::number>(), field<&Value::mode>()); }
};
constexpr auto enumerators(Value::Mode) {
  return std::array<jarol::Enumerator<Value::Mode>, 2>{{{"on", Value::Mode::on}, {"off", Value::Mode::off}}};
}
#endif
}  // namespace

namespace {
struct Task {
#if NOT_A_VALUE != 24  // a task that does not say what it does
  static constexpr std::string_view summary = "has such an output";
#endif
  using Out = Value;
#if NOT_A_VALUE == 25    // without what it does
#elif NOT_A_VALUE == 26  // what it writes would be lost
  static void run(const jarol::Tick&, Out) {}
#elif NOT_A_VALUE == 27  // so would what it returns
  static double run(const jarol::Tick&, Out&) { return 1; }
#elif NOT_A_VALUE == 28  // without the time
  static void run(Out&) {}
#elif NOT_A_VALUE == 29  // of an object
  void run(const jarol::Tick&, Out&) {}
#elif NOT_A_VALUE == 30  // a state where the task has none
  static void run(const jarol::Tick&, Value&, Out&) {}
#else
  static void run(const jarol::Tick&, Out&) {}
#endif
};
template <class Number>
struct OfTemplate : Task {};
}  // namespace

#if NOT_A_VALUE == 0
struct OfDoubles : OfTemplate<double> {};
JAROL_PLUGIN(Task, OfDoubles)
#elif NOT_A_VALUE == 38  // a task whose name is that of its argument
JAROL_PLUGIN(OfTemplate<double>)
#else
JAROL_PLUGIN(Task)
#endif
