// A plugin of another time, as its file says.
extern "C" [[gnu::used]] const struct {
  char magic[16];
  int numbers[17];
  char compiler[64];
} jarol_plugin_build = {
    {'j', 'a', 'r', 'o', 'l', ' ', 'p', 'l', 'u', 'g', 'i', 'n', ' ', 'o', 'f', ':'}, {3}, "g++ 4.2"};
