// A library that is loaded so that its calls end in the libraries it names itself.
#include <cmath>

extern "C" double deep_sine(double x) { return std::sin(x); }
