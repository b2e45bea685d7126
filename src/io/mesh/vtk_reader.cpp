// SPDX-License-Identifier: LGPL-3.0-or-later
// The module that reads legacy VTK and VTK XML by VTK's readers, from memory. Messages of VTK become the
// error instead of being printed.
#include <fmt/format.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersion.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>
#include <optional>
#include <regex>

#include "io/files/text.h"
#include "reader_module.h"
#include "vtk_cells.h"
#include "vtk_lists.h"

namespace cellwalk::io {
namespace {

/// Keeps the first message instead of printing it.
class Listener : public vtkOutputWindow {
 public:
  static Listener* New() { VTK_STANDARD_NEW_BODY(Listener); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void DisplayText(const char* text) override {
    if (first_.empty()) first_ = text;
  }
  const std::string& first() const { return first_; }

 protected:
  Listener() = default;
  ~Listener() override = default;

 private:
  std::string first_;
};

/// Replaces VTK's output and log, which are global, by a listener during its lifetime.
class Silence {
 public:
  Silence() : before_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(listener_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  const std::string& complaint() const { return listener_->first(); }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkNew<Listener> listener_;
};

/// The text of a message in one line, without file names of VTK and addresses of its objects.
std::string essence(const std::string& complaint) {
  static const std::regex head(R"(^(ERROR|Warning|Generic Warning): In [^\n]*\n(\w+ \(0x[0-9a-f]+\): )?)");
  std::string text = std::regex_replace(complaint, head, "", std::regex_constants::format_first_only);
  text = text.substr(0, text.find('\n'));
  if (text.starts_with("Could not read file")) return "its line DATASET is missing, or names an unknown kind";
  static const std::regex noise(R"(\s*\(0x[0-9a-f]+\)| for file:? *$)");  // it was read from memory
  return std::regex_replace(text, noise, "");
}

[[noreturn]] void refuse(const std::string& name, const std::string& format, const std::string& complaint) {
  const std::string why = complaint.empty() ? "no reason given" : essence(complaint);
  const std::string what = fmt::format("broken or cut short: VTK cannot read it as {} ({})", format, why);
  static const std::regex line(R"(at line (\d+))");
  std::smatch match;
  if (std::regex_search(why, match, line)) fail(name, std::stoul(match[1]), what);
  fail(name, what);
}

Read_elements from_data_object(const std::string& name, vtkDataObject* data, const std::string& format,
                               const std::string& complaint) {
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data); grid && complaint.empty())
    return read_cells(name, *grid);
  if (auto* surface = vtkPolyData::SafeDownCast(data); surface && complaint.empty())
    return read_cells(name, *surface);
  if (data && complaint.empty())
    fail(name, fmt::format("holds a {}: only unstructured grids and polygonal data are read",
                           data->GetClassName()));
  refuse(name, format, complaint);
}

Read_elements parse_legacy(const std::string& name, std::string bytes, Read_report& report) {
  Line_reader in(name, bytes, std::nullopt);
  in.next_line();
  const std::string_view first = in.rest(), title = "# vtk DataFile Version ";
  const bool titled = same_word(first.substr(0, title.size()), title);
  if (!titled) in.fail("not a VTK file: it does not begin with '# vtk DataFile Version'");
  report.format = fmt::format("VTK legacy {}", first.substr(title.size()));
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail(name, "larger than 2 GiB, which VTK cannot read as a legacy file: write it as .vtu");
  const std::optional<std::string> broken = hide_broken_lists(bytes);
  const Silence silence;
  vtkNew<vtkGenericDataObjectReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetBinaryInputString(bytes.data(), static_cast<int>(bytes.size()));
  reader->Update();
  if (broken && (!reader->GetOutput() || !silence.complaint().empty())) fail(name, *broken);
  return from_data_object(name, reader->GetOutput(), report.format, silence.complaint());
}

template <class Reader>
Read_elements parse_xml_by(const std::string& name, const std::string& bytes, const std::string& format) {
  const Silence silence;
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  return from_data_object(name, reader->GetOutput(), format, silence.complaint());
}

Read_elements parse_xml(const std::string& name, const std::string& bytes, Read_report& report) {
  static const std::regex tag(R"(<VTKFile[^>]*\btype\s*=\s*["'](\w+)["'][^>]*>)");
  constexpr std::ptrdiff_t searched = 4096;  // the opening tag is at the beginning
  std::smatch match;
  const auto end =
      bytes.begin() + std::min<std::ptrdiff_t>(searched, static_cast<std::ptrdiff_t>(bytes.size()));
  if (!std::regex_search(bytes.begin(), end, match, tag))
    fail(name, "not a VTK XML file: it has no tag <VTKFile type=...>");
  report.format = "VTK XML " + match[1].str();
  if (match[1] == "UnstructuredGrid")
    return parse_xml_by<vtkXMLUnstructuredGridReader>(name, bytes, report.format);
  if (match[1] == "PolyData") return parse_xml_by<vtkXMLPolyDataReader>(name, bytes, report.format);
  fail(name, fmt::format("holds a {}: only UnstructuredGrid and PolyData are read", match[1].str()));
}

Element_soup read_with_vtk(const std::string& name, const Reader_input& input, Read_report& report) {
  const std::string bytes(input.bytes);
  Read_elements read =
      input.format == Format::vtk_xml ? parse_xml(name, bytes, report) : parse_legacy(name, bytes, report);
  report.notes = std::move(read.notes);
  read.collapsed.report_to(report);
  return std::move(read.elements);
}

constexpr Reader_module vtk_reader{CELLWALK_VERSION, VTK_VERSION, read_with_vtk};

}  // namespace
}  // namespace cellwalk::io

CELLWALK_READER_MODULE(cellwalk::io::vtk_reader)
