// All that a database of SQLite holds, whatever order it was written in, and changes to it.
#pragma once

#include <doctest/doctest.h>
#include <sqlite3.h>

#include <cstdio>
#include <string>
#include <vector>

namespace command {

/// The statements that make its tables, then a line for each row in order of its key; numbers to the bit.
inline std::string database_content(const std::string& path) {
  sqlite3* database = nullptr;
  // to be written, as a rank that was killed may have left its last rows in the log beside it
  REQUIRE(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK);
  const auto rows = [&](const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    REQUIRE(sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK);
    std::vector<std::vector<std::string>> all;
    int code = 0;
    while ((code = sqlite3_step(statement)) == SQLITE_ROW) {
      std::vector<std::string>& row = all.emplace_back();
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        char number[40] = "";
        switch (sqlite3_column_type(statement, i)) {
          case SQLITE_NULL: row.emplace_back("null"); break;
          case SQLITE_FLOAT:
            std::snprintf(number, sizeof number, "%a", sqlite3_column_double(statement, i));
            row.emplace_back(number);
            break;
          default:
            row.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement, i)),
                             static_cast<std::size_t>(sqlite3_column_bytes(statement, i)));
        }
      }
    }
    CHECK(code == SQLITE_DONE);
    sqlite3_finalize(statement);
    return all;
  };
  std::string text;
  for (const std::vector<std::string>& table :
       rows("SELECT name, sql FROM sqlite_schema WHERE type = 'table' ORDER BY name")) {
    text += table[1] + "\n";
    for (const std::vector<std::string>& row : rows("SELECT * FROM \"" + table[0] + "\" ORDER BY 1")) {
      for (const std::string& cell : row) text += cell + "\t";
      text += "\n";
    }
  }
  CHECK(sqlite3_close(database) == SQLITE_OK);
  return text;
}

inline void change_database(const std::string& path, const std::string& sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK);
  CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  CHECK(sqlite3_close(database) == SQLITE_OK);
}

}  // namespace command
