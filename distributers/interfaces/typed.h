// From a distributer of its own type to an AnyDistributer: channels by number, messages by id. In one file: it is one
// class, whose members a distributer may have or not.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <type_traits>
#include <utility>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/interfaces/distributer.h"
#include "distributers/interfaces/typed_traits.h"
#include "graph/registry.h"
#include "graph/values/type_of.h"

namespace jarol::distributers {

template <class D>
class Typed final : public AnyDistributer {
 public:
  using Param = decltype(detail::parameters_of<D>());
  using In = decltype(detail::in_of<D>());
  using Out = decltype(detail::out_of<D>());

  Typed() : Typed(Param{}) {}
  /// Throws what the distributer throws, InputError if there can be none with them.
  explicit Typed(const Param& parameters) : distributer_(make(parameters)) {}

  D& operator*() { return distributer_; }
  D* operator->() { return &distributer_; }

  const messages::MessageSet& message_set() const override { return D::message_set(); }
  void receive(messages::MessageRef message) override {
    if constexpr (detail::has_any_message<D>) distributer_.any_message(message);
    if constexpr (!D::is_vehicle) count_used();
    for (auto handler = find_handler(message.descriptor->id); handler->id == message.descriptor->id; ++handler) {
      if (handler->descriptor != message.descriptor) continue;
      if constexpr (D::is_vehicle) count_used();
      return handler->call(distributer_, message);
    }
  }
  std::uint64_t used() const override { return used_.load(std::memory_order_relaxed); }
  void peer_changed() override {
    if constexpr (detail::has_peer_changed<D>) distributer_.peer_changed();
  }
  void reach([[maybe_unused]] Duration instant, [[maybe_unused]] messages::Receiver& system) override {
    if constexpr (detail::has_reach<D>) distributer_.reach(instant, system);
  }
  void listen_at([[maybe_unused]] const std::string& address) override {
    if constexpr (detail::has_listen_at<D>) distributer_.listen_at(address);
  }
  void announce([[maybe_unused]] Duration instant, [[maybe_unused]] messages::Receiver& all) override {
    if constexpr (detail::has_announce<D>) distributer_.announce(instant, all);
  }
  void ending() override {
    if constexpr (detail::has_ending<D>) distributer_.ending();
  }
  bool overrides_end() const override {
    if constexpr (detail::has_overrides_end<D>) return distributer_.overrides_end();
    return false;
  }
  bool steers_itself() const override {
    if constexpr (detail::has_steers_itself<D>) return distributer_.steers_itself();
    return false;
  }
  void finish() override {
    if constexpr (detail::has_finish<D>) distributer_.finish();
  }
  void take_over() override {
    if constexpr (detail::has_take_over<D>) distributer_.take_over();
  }
  // of a distributer that does not say what it has beside `in`, it is looked whether there can be anything
  void serialize(Archive& archive) override {
    if constexpr (requires { distributer_.in; })
      with_described(distributer_.in, [&](auto&... member) { archive(member...); });
    if constexpr (detail::has_serialize<D>)
      distributer_.serialize(archive);
    else if constexpr (!has_nothing_beside_in())
      throw NotSaveable(std::string(type_name<D>()) + " has members of its own, and no serialize(Archive&)");
  }
  std::uint64_t non_finite_inputs() const override {
    if constexpr (detail::has_non_finite_inputs<D>) return distributer_.non_finite_inputs();
    return 0;
  }

  bool take(std::size_t channel, void* value) override { return takes[channel](distributer_, value); }
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override {
    sends[channel - in_count](distributer_, value, system);
  }

  /// The same of a channel by its name, as in take<&In::motion>(motion).
  template <auto Channel>
  bool take(typename Field<Channel>::Value::Value& value) {
    return take_channel<Channel>(distributer_, &value);
  }
  template <auto Channel>
  void hand_over(const typename Field<Channel>::Value& value, messages::Receiver& system) {
    send_channel<Channel>(distributer_, &value, system);
  }
  template <SomeMessage M>
  void receive(const M& message) {
    receive(messages::refer_to(message));
  }

 private:
  void count_used() { used_.store(used_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  static_assert(
      requires {
        { D::message_set() } -> std::same_as<const messages::MessageSet&>;
      },
      "a distributer has a static message_set() that returns the messages::MessageSet it speaks");
  static_assert(
      requires { D::handlers(); },
      "a distributer has a static constexpr handlers(): return handle(on<M>(...), send<&Out::x>(...));");
  static_assert(Described<In>, "In has fields(): return describe(channel<&In::x>(\"what it is\"));");
  static_assert(Described<Out>, "Out has fields(): return describe(channel<&Out::x>(\"what it is\"));");

  using Handlers = decltype(D::handlers());
  static constexpr std::size_t entry_count = std::tuple_size_v<Handlers>;
  static constexpr std::size_t in_count = decltype(In::fields())::count;
  static constexpr std::size_t out_count = decltype(Out::fields())::count;

  static constexpr bool has_nothing_beside_in() {
    if constexpr (requires(D & d) { d.in; })
      return sizeof(D) == sizeof(In);
    else
      return std::is_empty_v<D>;
  }

  static D make([[maybe_unused]] const Param& parameters) {
    if constexpr (detail::WithParameters<D>)
      return D(parameters);
    else
      return D();
  }

  template <std::size_t I>
  using Entry = std::tuple_element_t<I, Handlers>;

  // The entry of that kind for a channel; entry_count: there is none.
  template <auto Channel, detail::EntryKind Kind>
  static constexpr std::size_t find_entry() {
    std::size_t found = entry_count, count = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const auto look = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) {
        if constexpr (detail::EntryOf<Entry<J>>::kind == Kind)
          if (detail::same_member<Entry<J>::channel, Channel>()) found = J, ++count;
      };
      (look(std::integral_constant<std::size_t, I>{}), ...);
    }
    (std::make_index_sequence<entry_count>{});
    return count > 1 ? entry_count + 1 : found;
  }

  using Call = void (*)(D&, const messages::MessageRef&);
  struct Handler {
    std::uint32_t id = 0;
    const messages::MessageDescriptor* descriptor = nullptr;
    Call call = nullptr;
  };

  template <std::size_t I>
  static void call(D& distributer, const messages::MessageRef& message) {
    using M = typename Entry<I>::Message;
    constexpr auto entry = std::get<I>(D::handlers());
    constexpr bool wants_header =
        std::is_invocable_v<decltype(entry.handler), D&, const M&, const messages::MessageRef&>;
    static_assert(wants_header || std::is_invocable_v<decltype(entry.handler), D&, const M&>,
                  "the handler of on<M> is called with the distributer and a const M&");
    const M& itself = *static_cast<const M*>(message.value);
    if constexpr (wants_header)
      std::invoke(entry.handler, distributer, itself, message);
    else
      std::invoke(entry.handler, distributer, itself);
  }

  // By id; the last stands for what is not handled.
  static constexpr auto make_handlers() {
    std::array<Handler, entry_count + 1> all{};
    std::size_t count = 0;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const auto add = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) {
        if constexpr (detail::EntryOf<Entry<J>>::kind == detail::EntryKind::on)
          all[count++] = {Entry<J>::Message::message_id, &Entry<J>::Message::descriptor, &call<J>};
      };
      (add(std::integral_constant<std::size_t, I>{}), ...);
    }
    (std::make_index_sequence<entry_count>{});
    std::sort(all.begin(), all.begin() + count, [](const Handler& a, const Handler& b) { return a.id < b.id; });
    for (; count < all.size(); ++count) all[count].id = no_message;
    return all;
  }
  static constexpr std::uint32_t no_message = 0xffffffff;

  // Does that entry handle this message? By types: with sanitizers addresses are no constants.
  template <std::size_t I, class M>
  static constexpr bool is_handler_of() {
    if constexpr (detail::EntryOf<Entry<I>>::kind == detail::EntryKind::on)
      return std::is_same_v<typename Entry<I>::Message, M>;
    else
      return false;
  }

  template <std::size_t I>
  static constexpr bool is_only_handler() {
    if constexpr (detail::EntryOf<Entry<I>>::kind == detail::EntryKind::on)
      return []<std::size_t... J>(std::index_sequence<J...>) {
        return ((is_handler_of<J, typename Entry<I>::Message>() ? 1 : 0) + ... + 0) == 1;
      }
    (std::make_index_sequence<entry_count>{});
    else return true;
  }

  static constexpr bool handles_each_once() {
    return []<std::size_t... I>(std::index_sequence<I...>) { return (is_only_handler<I>() && ...); }
    (std::make_index_sequence<entry_count>{});
  }

  static const Handler* find_handler(std::uint32_t id) {
    static constexpr auto handlers = make_handlers();
    static_assert(handles_each_once(), "a message has one handler, one on<M>(...)");
    return std::lower_bound(handlers.data(), handlers.data() + handlers.size() - 1, id,
                            [](const Handler& handler, std::uint32_t wanted) { return handler.id < wanted; });
  }

  template <auto Channel>
  static bool take_channel(D& distributer, void* value) {
    using C = typename Field<Channel>::Value;
    static_assert(detail::is_newest<C> || detail::is_computed<C>,
                  "a channel of In is a Newest<T>, which messages bring, or a Computed<T>");
    constexpr std::size_t at = find_entry<Channel, detail::EntryKind::compute>();
    if constexpr (detail::is_newest<C>) {
      static_assert(at == entry_count, "compute<&In::x> is for a Computed<T>; a Newest<T> is written by handlers");
      static_assert(
          requires {
            { (distributer.in) } -> std::same_as<In&>;
          },
          "a distributer has a public member `In in`, which its handlers write");
      C& channel = distributer.in.*Channel;
      if (!std::exchange(channel.is_new, false)) return false;
      *static_cast<typename C::Value*>(value) = channel.value;
    } else {
      static_assert(at < entry_count, "each Computed<T> of In needs one compute<&In::x>(...) in handlers()");
      constexpr auto entry = std::get<at>(D::handlers());
      static_assert(std::is_invocable_r_v<typename C::Value, decltype(entry.handler), D&>,
                    "the handler of compute<&In::x> returns the channel's value");
      *static_cast<typename C::Value*>(value) = std::invoke(entry.handler, distributer);
    }
    return true;
  }

  template <auto Channel>
  static void send_channel(D& distributer, const void* value, messages::Receiver& system) {
    using T = typename Field<Channel>::Value;
    constexpr std::size_t at = find_entry<Channel, detail::EntryKind::send>();
    static_assert(at < entry_count, "each channel of Out needs one send<&Out::x>(...) in handlers()");
    constexpr auto entry = std::get<at>(D::handlers());
    static_assert(std::is_invocable_v<decltype(entry.handler), D&, const T&, messages::Receiver&>,
                  "the handler of send<&Out::x> is called with the distributer, the value and a messages::Receiver&");
    std::invoke(entry.handler, distributer, *static_cast<const T*>(value), system);
  }

  // In the order of their description.
  static constexpr auto takes = []<auto... Channel>(FieldList<Channel...>) {
    return std::array<bool (*)(D&, void*), sizeof...(Channel)>{&take_channel<Channel>...};
  }
  (In::fields());
  static constexpr auto sends = []<auto... Channel>(FieldList<Channel...>) {
    return std::array<void (*)(D&, const void*, messages::Receiver&), sizeof...(Channel)>{&send_channel<Channel>...};
  }
  (Out::fields());

  D distributer_;
  std::atomic<std::uint64_t> used_{0};
};

/// The description of a distributer and what makes it, as the registry has it.
template <class D>
DistributerClass distributer_class() {
  using T = Typed<D>;
  DistributerClass made{std::string(type_name<D>()), std::string(D::summary), {}, D::is_vehicle};
  with_fields(T::In::fields(), [&](auto... f) {
    (made.channels.push_back(
         {std::string(f.name), Direction::in, &type_of<typename decltype(f)::Value::Value>(), std::string(f.text)}),
     ...);
  });
  with_fields(T::Out::fields(), [&](auto... f) {
    (made.channels.push_back(
         {std::string(f.name), Direction::out, &type_of<typename decltype(f)::Value>(), std::string(f.text)}),
     ...);
  });
  if constexpr (detail::WithParameters<D>) made.parameters = &type_of<typename D::Param>();
  made.message_set = &D::message_set;
  made.make = []([[maybe_unused]] const void* parameters) -> std::unique_ptr<AnyDistributer> {
    if constexpr (detail::WithParameters<D>)
      return std::make_unique<T>(*static_cast<const typename D::Param*>(parameters));
    else
      return std::make_unique<T>();
  };
  return made;
}

}  // namespace jarol::distributers
