// The cells of the results of a campaign, as SQLite keeps them.
#pragma once

#include <cstdint>
#include <string>

#include "distributers/campaign/result.h"

struct sqlite3_stmt;

namespace jarol::campaign {

std::string text_of(sqlite3_stmt* row, int column);
void bind_text(sqlite3_stmt* to, int place, const std::string& text);
/// Numbers as numbers, so that queries can compare them; what SQL has no number for as a word.
void bind_number(sqlite3_stmt* to, int place, double number);
/// The largest as a text: SQL's whole numbers end at 2^63 - 1, and its others round.
void bind_seed(sqlite3_stmt* to, int place, std::uint64_t seed);
/// What varied, as a number where it is one.
void bind_value(sqlite3_stmt* to, int place, const std::string& value);
Reached reached_of(sqlite3_stmt* row, int column);
/// Is it what is written of a metric: a number with a point, a word, or nothing?
bool is_reached(sqlite3_stmt* row, int column);
bool is_count(sqlite3_stmt* row, int column);

}  // namespace jarol::campaign
