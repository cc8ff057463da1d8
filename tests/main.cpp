#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <iostream>
#include <string>
#include <vector>

namespace {

// The cases that failed once more at the end, away from what messages print between them.
class FailedCases : public doctest::IReporter {
 public:
  explicit FailedCases(const doctest::ContextOptions& options) : out_(*options.cout) {}

  void test_case_start(const doctest::TestCaseData& at) override { case_ = &at; }
  void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
    if (!stats.testCaseSuccess)
      failed_.push_back(std::string(case_->m_file.c_str()) + ":" + std::to_string(case_->m_line) + ": " +
                        case_->m_name);
  }
  void test_run_end(const doctest::TestRunStats&) override {
    for (const std::string& each : failed_) out_ << "FAILED: " << each << "\n";
  }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  std::ostream& out_;
  const doctest::TestCaseData* case_ = nullptr;
  std::vector<std::string> failed_;
};

REGISTER_LISTENER("failed cases", 1, FailedCases);

}  // namespace
