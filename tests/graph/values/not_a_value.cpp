// What does not compile as a value; NOT_A_VALUE says which, 0 is one that does.
#include "graph/values/type_of.h"

namespace {
using namespace jarol;

#if NOT_A_VALUE == 1  // a pointer
struct Value {
  const double* number = nullptr;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 2  // a reference
struct Value {
  double& number;
  static constexpr auto fields() { return describe(); }
};
#elif NOT_A_VALUE == 3  // a member that is not described
struct Value {
  double number = 0;
  double forgotten = 0;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#elif NOT_A_VALUE == 4  // a member without a description of its own
struct Inner {
  double number = 0;
};
struct Value {
  Inner inner{};
  static constexpr auto fields() { return describe(field<&Value::inner>()); }
};
#else
struct Value {
  double number = 0;
  static constexpr auto fields() { return describe(field<&Value::number>()); }
};
#endif
}  // namespace

const Type& what() { return type_of<Value>(); }
