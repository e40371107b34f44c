#include "report.hpp"
#include "text.hpp"

namespace report {

using nlohmann::json;

void write_frames(const json& section, Report& report) {
  const json& programs = section.at("programs");
  if (programs.empty()) return;
  report.heading("A moved camera");
  report.text(design_title(section.at("design")) + " is drawn from memory at " +
              number(section.at("width_px")) + "×" + number(section.at("height_px")) + " by " +
              number(section.at("threads")) + " threads, in " + number(section.at("frames")) +
              " frames of a camera that turns by " + number(section.at("turn_deg")) +
              "° from one to the next.");
  if (section.contains("mesh")) {
    const json& mesh = section.at("mesh");
    report.text("Embree traces a finished mesh of " + whole_number(mesh.at("triangles")) +
                " triangles (" + number(mesh.at("fragments")) + " fragments a circle; " +
                mesh.at("method").get<std::string>() +
                "). The time of making that mesh is not counted.");
  }
  Table table({"program", "ms a frame", "made once, ms", "what", "to Embree's frame"});
  for (const json& program : programs) {
    table.add({program.at("name"), with_spread(program.at("frame_ms")),
               number(median(program.at("prepare_ms"))), program.at("prepares"),
               program.contains("ratio") ? number(program.at("ratio")) : "–"});
  }
  report.table(table);
  if (section.contains("ratio")) {
    const json& ratio = section.at("ratio");
    const bool is_met = ratio.at("value") <= ratio.at("at_most");
    report.text(capitalised(ratio.at("what")) + ": " + number(ratio.at("value")) +
                " (wanted: at most " + number(ratio.at("at_most")) +
                (is_met ? ", reached)." : ", missed)."));
  }
  if (section.contains("agreement")) {
    const json& agreement = section.at("agreement");
    report.text("Of " + whole_number(agreement.at("pixels")) + " pixels of the same facets " +
                whole_number(agreement.at("other_hit")) +
                " are a hit in one of the two pictures and a miss in the other, and " +
                whole_number(agreement.at("other_depth")) + " differ in depth.");
  }
}

}  // namespace report
