// A shared library that has nothing to do with Jarol.
extern "C" int answer() { return 42; }
