#include "runtime/jarol/signal.h"

namespace jarol {

template class BasicSignal<Futex>;

std::string_view to_text(Signalling result) {
  switch (result) {
    case Signalling::done: return "signalled";
    case Signalling::not_awaited: return "signalled with no one waiting";
    case Signalling::during_signalling: return "signalled during a signalling";
    case Signalling::interrupted: return "signalled while interrupted";
  }
  return "";
}

std::string_view to_text(Awaiting result) {
  switch (result) {
    case Awaiting::signalled: return "was signalled";
    case Awaiting::during_signalling: return "awaited during a signalling";
    case Awaiting::timed_out: return "waited in vain";
    case Awaiting::interrupted: return "was interrupted while awaiting";
  }
  return "";
}

}  // namespace jarol
