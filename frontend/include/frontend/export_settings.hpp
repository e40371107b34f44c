// What -O asks of exported files, by OpenSCAD's names.
#pragma once

#include <string>

namespace frontend {

/// The settings of -O that have a meaning for scadray's formats. Colours are #rrggbb, #rgb or one
/// of the names that color() knows; words are one of those that --help-export lists. Empty texts
/// are not written.
struct ExportSettings {
  struct Stroke {
    bool fill = false;
    std::string fill_color = "white";
    bool stroke = true;
    std::string stroke_color = "black";
    double stroke_width = 0;  // in millimetres
  };
  Stroke svg{.fill = true, .fill_color = "lightgray", .stroke_width = 0.5};
  Stroke pdf{.fill_color = "black", .stroke_width = 25.4 / 72};
  std::string pdf_paper = "a4";  // larger where the figure needs it
  std::string pdf_orientation = "portrait";
  bool pdf_meta_data = true;
  std::string pdf_title = "OpenSCAD Model";
  std::string pdf_author;
  std::string pdf_subject;
  std::string pdf_keywords;
  std::string three_mf_colors = "model";
  std::string three_mf_unit = "millimeter";  // what a length of 1 is
  std::string three_mf_color = "#f9d72c";    // of the whole solid, with the colours selected-only
  std::string three_mf_material = "basematerial";
  bool three_mf_meta_data = true;
  std::string three_mf_title;
  std::string three_mf_designer;
  std::string three_mf_description;
  std::string three_mf_copyright;
  std::string three_mf_license;
  std::string three_mf_rating;
};

}  // namespace frontend
