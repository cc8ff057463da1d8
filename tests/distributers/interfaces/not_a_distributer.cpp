// What does not compile as a distributer; CASE says which, 0 is one that does.
#include "distributers/interfaces/typed.h"
#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace javiator = messages::javiator;

struct Lamp {
  static constexpr std::string_view summary = "shines";
  static constexpr bool is_vehicle = true;
#if CASE == 1  // a channel that is no channel
  struct In {
    double depth = 0;
#else
  struct In {
    Newest<double> depth;
#endif
    static constexpr auto fields() { return describe(channel<&In::depth>("how deep it is")); }
  };
  struct Out {
    bool lit = false;
    static constexpr auto fields() { return describe(channel<&Out::lit>("whether it shines")); }
  };
#if CASE != 2
  static const messages::MessageSet& message_set() { return javiator::message_set(); }
#endif
  static constexpr auto handlers() {
#if CASE == 3  // a channel without a handler
    return handle(on<javiator::IdleLimit>(&Lamp::hear));
#elif CASE == 4  // a message twice
    return handle(on<javiator::IdleLimit>(&Lamp::hear), on<javiator::IdleLimit>(&Lamp::hear),
                  send<&Out::lit>(&Lamp::shine));
#elif CASE == 5  // no message
  return handle(on<double>(&Lamp::hear), send<&Out::lit>(&Lamp::shine));
#elif CASE == 6  // the handler of another message
  return handle(on<javiator::StoreTrim>(&Lamp::hear), send<&Out::lit>(&Lamp::shine));
#elif CASE == 7  // the handler of another channel
  return handle(on<javiator::IdleLimit>(&Lamp::hear), send<&Out::lit>(&Lamp::hear));
#else
  return handle(on<javiator::IdleLimit>(&Lamp::hear), send<&Out::lit>(&Lamp::shine));
#endif
  }
  void hear(const javiator::IdleLimit&) {}
  void shine(bool, messages::Receiver&) {}
#if CASE == 8  // a hook that is called with something else
  void reach(double) {}
#endif
#if CASE != 9
  In in;
#endif
};
}  // namespace

DistributerClass made() { return distributer_class<Lamp>(); }
