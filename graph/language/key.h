// Tables of keys: what a mapping of the graph language may hold. The loader and the JSON Schema both read them.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "graph/language/spec.h"

namespace jarol {

/// How the value of a key is written.
enum class Form {
  word,
  address,    // a word: of a socket
  addresses,  // a word: of sockets, with commas and ranges of ports
  duration,
  positive_duration,
  integer,
  id,
  bytes,
  frequency,
  share,
  fault_limit,
  choice,
  mapping,
  any,
  section
};

/// What is said of a key to people and to editors, whatever reads it.
struct KeyDescription {
  std::string name;
  Form form = Form::word;
  bool required = false;
  std::string text;                                                      // meaning and default
  std::vector<std::string> choices;                                      // Form::choice
  std::int64_t min = 0, max = std::numeric_limits<std::int32_t>::max();  // Form::integer
  std::pair<std::int64_t, std::int64_t> limits{0, -1};  // Form::integer: of what is good, where something else checks
  std::vector<std::int64_t> integers;                   // the same: all that are
  std::vector<KeyDescription> keys;  // Form::mapping: what it may hold; empty: that is not known here
};

/// One key of a mapping that is read into an S; without `read` something else reads it.
template <class S>
struct Key : KeyDescription {
  void (*read)(const Key& key, const Yaml& yaml, S& to, const std::string& subject, Problems& problems) = nullptr;

  Key in_range(std::int64_t from, std::int64_t to) && {
    min = from;
    max = to;
    return std::move(*this);
  }
  /// The same where something else checks it.
  Key within(std::int64_t from, std::int64_t to) && {
    limits = {from, to};
    return std::move(*this);
  }
  Key one_of(std::vector<std::int64_t> values) && {
    integers = std::move(values);
    return std::move(*this);
  }
  template <class Within>
  Key holding(const std::vector<Key<Within>>& within) && {
    keys.assign(within.begin(), within.end());
    return std::move(*this);
  }
};

/// The words of an enumeration, in the order of its values.
template <class E>
struct Words;
template <>
struct Words<OnFault> {
  static std::vector<std::string> list() { return {"stop", "hold", "skip", "restart"}; }
};
template <>
struct Words<Direction> {
  static std::vector<std::string> list() { return {"in", "out"}; }
};
template <>
struct Words<Isolation> {
  static std::vector<std::string> list() { return {"strong", "weak"}; }
};
template <>
struct Words<Phasing> {
  static std::vector<std::string> list() { return {"given", "any"}; }
};
template <>
struct Words<Sampling> {
  static std::vector<std::string> list() { return {"random", "latin"}; }
};

/// Reports what is wrong and returns false, or `to` is which of the choices it is.
bool read_choice(const Yaml& yaml, const std::vector<std::string>& choices, std::size_t& to, const std::string& subject,
                 Problems& problems);

namespace detail {

// Each reports what is wrong and returns false, or fills `to`.
bool read_word(const Yaml& yaml, std::string& to, const std::string& subject, Problems& problems);
bool read_duration(const Yaml& yaml, bool positive, Duration& to, const std::string& subject, Problems& problems);
bool read_integer(const Yaml& yaml, std::int64_t min, std::int64_t max, std::int64_t& to, const std::string& subject,
                  Problems& problems);
bool read_id(const Yaml& yaml, std::int64_t& to, const std::string& subject, Problems& problems);
bool read_bytes(const Yaml& yaml, std::int64_t& to, const std::string& subject, Problems& problems);
bool read_frequency(const Yaml& yaml, double& to, const std::string& subject, Problems& problems);  // rad/s
bool read_share(const Yaml& yaml, double& to, const std::string& subject, Problems& problems);      // of 1
bool read_fault_limit(const Yaml& yaml, FaultLimit& to, const std::string& subject, Problems& problems);
bool read_mapping_value(const Yaml& yaml, const std::string& subject, Problems& problems);

template <auto Member, class S, class T>
void read_member(const Key<S>& key, const Yaml& yaml, S& to, const std::string& subject, Problems& problems) {
  const std::string what = (subject.empty() ? "" : subject + " ") + "key '" + key.name + "'";
  Located<T> value;
  value.where = yaml.where;
  bool good = false;
  if constexpr (std::is_same_v<T, std::string>) {
    good = read_word(yaml, value.value, what, problems);
  } else if constexpr (std::is_same_v<T, Duration>) {
    good = read_duration(yaml, key.form == Form::positive_duration, value.value, what, problems);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    good = key.form == Form::bytes ? read_bytes(yaml, value.value, what, problems)
           : key.form == Form::id  ? read_id(yaml, value.value, what, problems)
                                   : detail::read_integer(yaml, key.min, key.max, value.value, what, problems);
  } else if constexpr (std::is_same_v<T, double>) {
    good = key.form == Form::share ? read_share(yaml, value.value, what, problems)
                                   : read_frequency(yaml, value.value, what, problems);
  } else if constexpr (std::is_same_v<T, FaultLimit>) {
    good = read_fault_limit(yaml, value.value, what, problems);
  } else if constexpr (std::is_same_v<T, Yaml>) {
    good = key.form != Form::mapping || read_mapping_value(yaml, what, problems);
    value.value = yaml;
  } else {
    std::size_t index = 0;
    good = read_choice(yaml, key.choices, index, what, problems);
    value.value = static_cast<T>(index);
  }
  if (good) {
    to.*Member = std::move(value);
  } else {
    (to.*Member).bad = true;
  }
}

template <class M>
struct MaybeMember;
template <class S_, class T_>
struct MaybeMember<Maybe<T_> S_::*> {
  using S = S_;
  using T = T_;
};

}  // namespace detail

/// A key of an S whose value goes into the member of S, or of a struct from which S is derived.
template <class S, auto Member>
Key<S> key_for(std::string name, Form form, std::string text, bool required = false) {
  using T = typename detail::MaybeMember<decltype(Member)>::T;
  Key<S> made;
  made.name = std::move(name);
  made.form = form;
  made.required = required;
  made.text = std::move(text);
  if constexpr (std::is_enum_v<T>) made.choices = Words<T>::list();
  made.read = [](const Key<S>& k, const Yaml& yaml, S& to, const std::string& subject, Problems& problems) {
    detail::read_member<Member, S, T>(k, yaml, to, subject, problems);
  };
  return made;
}

/// A key whose value goes into the member.
template <auto Member, class M = detail::MaybeMember<decltype(Member)>>
Key<typename M::S> key(std::string name, Form form, std::string text, bool required = false) {
  return key_for<typename M::S, Member>(std::move(name), form, std::move(text), required);
}

/// A key that something else reads.
template <class S>
Key<S> key_read_elsewhere(std::string name, Form form, std::string text, bool required = false) {
  Key<S> made;
  made.name = std::move(name);
  made.form = form;
  made.required = required;
  made.text = std::move(text);
  return made;
}

/// Reads a mapping by its table. Unknown keys and required ones that lack are reported.
template <class S>
void read_keys(const Yaml& yaml, const std::vector<Key<S>>& keys, S& to, const std::string& subject,
               Problems& problems) {
  if (yaml.kind != Yaml::Kind::mapping) {
    problems.add(yaml.where, subject + " needs a mapping, not " + std::string(kind_name(yaml)));
    return;
  }
  for (const Yaml& child : yaml.children) {
    const Key<S>* found = nullptr;
    for (const Key<S>& k : keys)
      if (k.name == child.key) found = &k;
    if (found != nullptr) {
      if (found->read != nullptr) found->read(*found, child, to, subject, problems);
      continue;
    }
    std::vector<std::string> names;
    for (const Key<S>& k : keys) names.push_back(k.name);
    problems.add(child.key_where, subject + " has no key '" + child.key + "'" + did_you_mean(child.key, names) +
                                      "; it has: " + list_of(names));
  }
  for (const Key<S>& k : keys)
    if (k.required && yaml.find(k.name) == nullptr)
      problems.add(yaml.where, subject + " lacks the key '" + k.name + "': " + k.text);
}

}  // namespace jarol
