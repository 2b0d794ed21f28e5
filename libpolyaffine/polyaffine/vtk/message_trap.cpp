#include "polyaffine/vtk/message_trap.hpp"

#include <vtkObjectFactory.h>

namespace polyaffine {
namespace {

class FirstErrorWindow : public vtkOutputWindow {
 public:
  static FirstErrorWindow* New();
  vtkTypeMacro(FirstErrorWindow, vtkOutputWindow)

      void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (!error.empty()) return;
    // VTK's form: "ERROR: In file, line n\nclass (address): message\n\n"; only the message helps a user.
    error = text;
    const auto head = error.find("): ");
    if (head != std::string::npos) error.erase(0, head + 3);
    error.erase(error.find_last_not_of(" \n") + 1);
  }

  std::string error;
};
vtkStandardNewMacro(FirstErrorWindow);

}  // namespace

MessageTrap::MessageTrap()
    : previous_(vtkOutputWindow::GetInstance()),
      window_(vtkSmartPointer<FirstErrorWindow>::New()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(window_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

MessageTrap::~MessageTrap() {
  vtkOutputWindow::SetInstance(previous_);
  vtkLogger::SetStderrVerbosity(verbosity_);
}

std::string MessageTrap::first_error() const {
  return static_cast<const FirstErrorWindow*>(window_.Get())->error;
}

}  // namespace polyaffine
