// A plugin of another time.
namespace jarol {
class Registry;
}
extern "C" const char* jarol_plugin_form() { return "form 0 of 4.2"; }
extern "C" void jarol_plugin_add(jarol::Registry&) {}
