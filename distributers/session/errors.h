// What a session refuses, by type; the text says what is wrong and what would be right. What is wrong with a graph is a
// SpecError.
#pragma once

#include <stdexcept>

namespace jarol {

/// All but SpecError.
struct SessionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Nothing of the graph has that name.
struct UnknownName : SessionError {
  using SessionError::SessionError;
};

/// The value of that name has another type than the program says.
struct WrongType : SessionError {
  using SessionError::SessionError;
};

/// It comes from elsewhere: the session was not opened so that the program feeds it.
struct NotFed : SessionError {
  using SessionError::SessionError;
};

/// It was not watched before it was run.
struct NotWatched : SessionError {
  using SessionError::SessionError;
};

/// An instant that the run has left behind.
struct WrongInstant : SessionError {
  using SessionError::SessionError;
};

/// The run has ended: by a fault, by an external system that was lost, or as it was finished.
struct RunOver : SessionError {
  using SessionError::SessionError;
};

/// An external system goes on by itself, whatever the logical clock says.
struct NeedsRealClock : SessionError {
  using SessionError::SessionError;
};

/// On the real clock: nothing executes its policy, this machine has too little for it, or check has a negative verdict.
struct NotExecutable : SessionError {
  using SessionError::SessionError;
};

/// One that check has a negative verdict on, and that was not to be run by force.
struct NotSchedulable : NotExecutable {
  using NotExecutable::NotExecutable;
};

/// What can't be saved, or a checkpoint that is damaged or of something else.
struct CheckpointRefused : SessionError {
  using SessionError::SessionError;
};

/// A vehicle whose motion has left what numbers can express, one in another process that is gone, or whatever a vehicle
/// or a distributer of the program's own throws.
struct SystemLost : SessionError {
  using SessionError::SessionError;
};

/// A value that was published is larger than what looks on at a run takes (specs/running.md); the run is over.
struct ValueTooLarge : SessionError {
  using SessionError::SessionError;
};

/// There is no text of a graph.
struct NoSource : SessionError {
  using SessionError::SessionError;
};

/// The program was compiled with options by which its values lie otherwise in memory than the library's, or by which it
/// computes otherwise.
struct WrongBuild : SessionError {
  using SessionError::SessionError;
};

}  // namespace jarol
