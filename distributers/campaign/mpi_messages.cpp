// Messages by MPI: a library of its own, which the program loads where mpirun has started it, so that nobody else
// waits for MPI to be loaded.
#include <mpi.h>

#include <cstddef>

#include "distributers/campaign/messages.h"

namespace {

class MpiMessages : public jarol::campaign::Messages {
 public:
  MpiMessages() {
    int provided = 0;
    // a message at a time, but not always from the same thread
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  }
  ~MpiMessages() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }

  void send(int to, const std::vector<std::byte>& bytes) override {
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD);
  }

  std::optional<std::pair<int, std::vector<std::byte>>> receive() override {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return std::pair(status.MPI_SOURCE, std::move(bytes));
  }

 private:
  int rank_ = 0, ranks_ = 1;
};

}  // namespace

extern "C" jarol::campaign::Messages* jarol_mpi_messages() { return new MpiMessages; }  // the program's, once
