// Where the messages of a chunk stand in it, by channel: the records that follow the chunk in the file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/mcap/records.h"

namespace jarol::mcap {

class MessageIndex {
 public:
  /// Of the records of a chunk, as far as they are whole.
  void make(std::string_view records);

  /// One for each channel that has messages, by its number.
  std::string_view records() const { return records_; }

  struct OfChannel {
    std::uint16_t channel = 0;
    std::uint64_t offset = 0;  // of its record within `records`
    std::uint64_t messages = 0;
  };
  const std::vector<OfChannel>& channels() const { return channels_; }

 private:
  std::string records_;
  std::vector<OfChannel> channels_;
  std::vector<std::uint64_t> counts_;  // by channel; zeros between two calls
};

}  // namespace jarol::mcap
