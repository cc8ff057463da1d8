// By its place and name an OpenBLAS.
extern "C" void dgemm_() {}
