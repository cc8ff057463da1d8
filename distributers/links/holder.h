// Who else holds a link's way to its peers.
#pragma once

#include <vector>

#include "distributers/links/address.h"

namespace jarol::distributers {

/// Called by a transport, from whichever of its threads changes the way, and by its link.
class Holder {
 public:
  virtual ~Holder() = default;
  /// From now on this is the way; datagrams go to each of these peers, or nowhere while there is none. Makes a
  /// duplicate of the descriptor, which stays the transport's.
  virtual void hold(int fd, const std::vector<Address>& peers) = 0;
  /// There is no way any more; the transport closes its descriptor after this.
  virtual void let_go() = 0;
  /// What is at the other end steers itself from now on, or no longer: meanwhile nothing is to be sent there. False: it
  /// could not be reported, and has to be again.
  virtual bool set_steers_itself(bool steers_itself) = 0;
};

}  // namespace jarol::distributers
