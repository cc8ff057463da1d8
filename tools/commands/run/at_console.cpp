#include "tools/commands/run/at_console.h"

#include "graph/text/errors.h"

namespace jarol::tools {

std::vector<console::DeskOperator> operators_at_console(const Loaded& loaded) {
  std::vector<console::DeskOperator> operators;
  for (std::size_t i = 0; i < loaded.systems.size(); ++i) {
    const Distributer& distributer = loaded.graph->distributers[i];
    if (auto* const system = dynamic_cast<distributers::ConsoleSystem*>(loaded.systems[i].get()))
      operators.push_back({distributer.name, distributer.distributer_class->name, system->port()});
  }
  return operators;
}

void require_console(const RunArguments& options, const Loaded& loaded) {
  const auto operators = operators_at_console(loaded);
  if (!operators.empty() && !options.console.wanted())
    throw InputError("distributer '" + operators.front().name +
                     "' has its operator at the console; run it with --console");
}

}  // namespace jarol::tools
