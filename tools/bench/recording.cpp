#include "tools/bench/recording.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "runtime/execute/executor.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

constexpr int chain_length = 100;
constexpr int milliseconds = 40'000;

// Header and bytes of each value, a mebibyte at a time.
class BytesFile : public RecordSink {
 public:
  explicit BytesFile(const std::vector<Output>& outputs) : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::runtime_error("can't make a file for the values to record");
    std::setvbuf(file_, nullptr, _IONBF, 0);
    for (const Output& output : outputs) sizes_.push_back(static_cast<std::uint32_t>(output.type->size));
  }
  ~BytesFile() override { std::fclose(file_); }
  BytesFile(const BytesFile&) = delete;
  BytesFile& operator=(const BytesFile&) = delete;

  void take(Duration instant, std::uint32_t output, const void* value) override {
    const RecordHeader header{instant.count(), output, sizes_[output]};
    if (bytes_.size() - used_ < sizeof header + header.size) finish();
    std::memcpy(bytes_.data() + used_, &header, sizeof header);
    std::memcpy(bytes_.data() + used_ + sizeof header, value, header.size);
    used_ += sizeof header + header.size;
    ++values_;
  }
  void finish() override {
    if (std::fwrite(bytes_.data(), 1, used_, file_) != used_) throw std::runtime_error("can't write recorded values");
    used_ = 0;
  }

  std::uint64_t values() const { return values_; }

 private:
  std::FILE* file_;
  std::vector<std::uint32_t> sizes_;  // per output
  std::vector<std::byte> bytes_ = std::vector<std::byte>(std::size_t{1} << 20);
  std::size_t used_ = 0;
  std::uint64_t values_ = 0;
};

double ns_per_value(const Graph& graph, bool digest) {
  BytesFile file(outputs_of(graph));
  Recorder recorder({&file});
  Executor executor(graph, {}, {.digest = digest, .recorder = &recorder});
  const double seconds = seconds_of([&] {
    executor.run_until(std::chrono::milliseconds(milliseconds));
    recorder.close();
  });
  return 1e9 * seconds / static_cast<double>(file.values());
}

}  // namespace

Figure measure_recording(const std::string& name, bool digest, double goal, int repeats) {
  Figure figure{name,
                1e300,
                "ns",
                1,
                0,
                goal,
                std::string("a value of 64 bytes computed") + (digest ? ", in the digest" : "") +
                    " and recorded to a file, of four million / 1 ns"};
  const Graph graph = graph_of(chain(chain_length, same_rate));
  for (int i = 0; i < std::max(3, repeats / 8); ++i) figure.value = std::min(figure.value, ns_per_value(graph, digest));
  figure.ratio = figure.value / figure.floor;
  return figure;
}

}  // namespace jarol::bench
