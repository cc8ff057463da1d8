// The radio between the helicopter's Robostix and its flight controller, as a vehicle file says.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "graph/values/archive.h"
#include "graph/values/describe.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

/// What happens to each packet, on either way, by chance, and when none passes.
struct PacketParameters {
  double loss = 0.0;
  double repeated = 0.0;
  double held = 0.0;
  double held_time = 0.03;
  double delay = 0.0;
  double cut_at = 1e9;
  double cut_time = 1e9;

  static constexpr auto fields() {
    using P = PacketParameters;
    return describe(field<&P::loss>("", "part of the packets that are lost").in(0, 1),
                    field<&P::repeated>("", "part that arrive twice").in(0, 1),
                    field<&P::held>("", "part that are held up").in(0, 1),
                    field<&P::held_time>("s", "for which they are").in(0, 1),
                    field<&P::delay>("s", "greatest delay of all others").in(0, 1),
                    field<&P::cut_at>("s", "since the start, from when on no packet passes").in(0, 1e9),
                    field<&P::cut_time>("s", "for which none does").in(0, 1e9));
  }

  /// Whether none passes at that time.
  bool is_cut(double seconds) const { return seconds >= cut_at && seconds - cut_at < cut_time; }
};

/// One way of the radio: packets of one kind, in the order in which they arrive.
template <class M>
class PacketLine {
 public:
  PacketLine() = default;
  PacketLine(const PacketParameters& parameters, std::uint64_t seed) : parameters_(parameters), noise_(seed) {}

  void send(const M& message, std::int64_t nanoseconds) {
    if (noise_.uniform() < parameters_.loss || parameters_.is_cut(1e-9 * static_cast<double>(nanoseconds))) return;
    const int copies = noise_.uniform() < parameters_.repeated ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      const double held = noise_.uniform() < parameters_.held ? parameters_.held_time : 0.0;
      const double delay = held + parameters_.delay * noise_.uniform();
      const Packet packet{nanoseconds + std::llround(1e9 * delay), message};
      const auto is_before = [](const Packet& a, const Packet& b) { return a.due < b.due; };
      waiting_.insert(std::upper_bound(waiting_.begin(), waiting_.end(), packet, is_before), packet);
    }
  }

  struct Packet {
    std::int64_t due = 0;  // ns
    M message{};
    void serialize(Archive& archive) {
      archive(due);
      archive.bytes(&message, sizeof message);
    }
  };

  /// Those that have arrived since it was asked last, up to that time.
  const std::vector<Packet>& arrive(std::int64_t nanoseconds) {
    const auto end =
        std::find_if(waiting_.begin(), waiting_.end(), [&](const Packet& packet) { return packet.due > nanoseconds; });
    arrived_.assign(waiting_.begin(), end);
    waiting_.erase(waiting_.begin(), end);
    return arrived_;
  }
  /// The same again.
  const std::vector<Packet>& arrived() const { return arrived_; }

  void serialize(Archive& archive) { archive(noise_, waiting_, arrived_); }

 private:
  PacketParameters parameters_{};
  Noise noise_{0};
  std::vector<Packet> waiting_, arrived_;
};

}  // namespace jarol::vehicles
