// What the messages of a topic hold, by the schema that the recording has of them: no type of the program is asked for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/record/recording.h"

namespace jarol {

enum class NumberKind { boolean, int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// A number in a message, or a sequence of whatever.
struct MessageColumn {
  std::string path;  // "" for a plain number, "a.b" for members, "a.0" for elements of arrays
  std::string unit;
  NumberKind kind{};
  bool is_sequence = false;
};

/// What stands in a column.
struct MessageCell {
  std::uint64_t bits = 0;  // of a number, as it lies in the message, zeros above
  std::string text{};      // of a sequence
};

class MessageLayout {
 public:
  /// Throws LogError where the schema is none that Jarol writes.
  explicit MessageLayout(const ReadTopic& topic);
  MessageLayout(const std::string& topic, const std::string& schema);

  const std::vector<MessageColumn>& columns() const { return columns_; }
  /// One for each column. Throws LogError where the bytes are not of that layout.
  std::vector<MessageCell> read(std::string_view bytes) const;

 private:
  struct Field {
    std::string name, unit;
    NumberKind kind{};
    int definition = -1;  // of a struct
    enum class Form { one, array, sequence } form = Form::one;
    std::uint32_t count = 0;  // of an array
  };
  struct Definition {
    std::vector<Field> fields;
    bool wraps = false;  // its one field is the value itself
  };
  struct Cursor;

  void parse(const std::string& schema);
  void add_columns(const Definition& definition, const std::string& path);
  void add_column(MessageColumn column);
  void read_fields(const Definition& definition, Cursor& in, std::vector<MessageCell>& cells) const;
  std::string text_of(const Field& field, Cursor& in, std::uint32_t count) const;

  std::vector<Definition> definitions_;
  std::vector<MessageColumn> columns_;
  std::size_t name_bytes_ = 0;  // of the columns
};

/// The shortest text that reads back exactly; truth values and enumerators as numbers.
std::string text_of(NumberKind kind, std::uint64_t bits);
/// The same for a cell.
std::string text_of(const MessageColumn& column, const MessageCell& cell);
/// As near as a double comes to it.
double number_of(NumberKind kind, std::uint64_t bits);
/// How far two numbers are apart.
double distance(NumberKind kind, std::uint64_t a, std::uint64_t b);
/// As in 0x3ff0000000000000: as many digits as its size asks for.
std::string bits_text(NumberKind kind, std::uint64_t bits);

}  // namespace jarol
