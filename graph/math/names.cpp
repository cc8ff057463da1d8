#include "graph/math/names.h"

#include "graph/math/functions.h"

namespace jarol::math {
namespace {

template <class Function>
Named named(const char* name, Function* function) {
  return {name, reinterpret_cast<const void*>(function)};
}

const Named all[]{
    named("sin", sin),         named("cos", cos),       named("tan", tan),       named("sincos", sincos),
    named("asin", asin),       named("acos", acos),     named("atan", atan),     named("atan2", atan2),
    named("sinh", sinh),       named("cosh", cosh),     named("tanh", tanh),     named("asinh", asinh),
    named("acosh", acosh),     named("atanh", atanh),   named("exp", exp),       named("exp2", exp2),
    named("exp10", exp10),     named("expm1", expm1),   named("log", log),       named("log2", log2),
    named("log10", log10),     named("log1p", log1p),   named("pow", pow),       named("cbrt", cbrt),
    named("hypot", hypot),     named("sinf", sinf),     named("cosf", cosf),     named("tanf", tanf),
    named("sincosf", sincosf), named("asinf", asinf),   named("acosf", acosf),   named("atanf", atanf),
    named("atan2f", atan2f),   named("sinhf", sinhf),   named("coshf", coshf),   named("tanhf", tanhf),
    named("asinhf", asinhf),   named("acoshf", acoshf), named("atanhf", atanhf), named("expf", expf),
    named("exp2f", exp2f),     named("exp10f", exp10f), named("expm1f", expm1f), named("logf", logf),
    named("log2f", log2f),     named("log10f", log10f), named("log1pf", log1pf), named("powf", powf),
    named("cbrtf", cbrtf),     named("hypotf", hypotf), named("cabs", cabs),     named("carg", carg),
    named("cabsf", cabsf),     named("cargf", cargf),
};

}  // namespace

std::span<const Named> names() { return all; }

}  // namespace jarol::math
