#ifndef rhombicComparison_h
#define rhombicComparison_h

#include "rhombicEvents.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** A field to sample. */
struct FieldRequest
{
  std::string kind;           ///< sphere, torus, gyroid, waves, marschner-lobb, corner, silhouettes or scan
  std::string object;         ///< of silhouettes: hand or quadruped
  double bandLimit = 0.5;     ///< of waves, in fractions of the Nyquist frequency of the grid
  unsigned int size = 40;     ///< samples along each axis of the grid whose spacing is h; not for silhouettes
  unsigned int pixels = 400;  ///< of silhouettes: along the object's height
  double turn = 0.0;          ///< of silhouettes: degrees about the vertical axis; a multiple of the views' 5
  std::filesystem::path file; ///< of scan
  double isovalue = 0.0;      ///< of scan
  double spacing = 1.0;       ///< of scan: h, in mm
  double sigma = 0.5;         ///< of scan: of the Gaussian that smooths it before, in h
  std::array<double, 3> center{ 0.5, 0.5, 0.5 }; ///< of scan: of the part that is taken, in fractions of the whole
};

/** A method and a number of samples. */
struct ComparedRow
{
  std::string method;                    ///< name of a ComparedMethod
  double samples = 0.0;                  ///< number of samples to come near to; 0: see density
  double density = 1.0;                  ///< samples per h^3
  bool isResampled = false;              ///< samples are those of the cubic B-spline through the grid of spacing h
  bool isShown = false;                  ///< in the pictures
  std::map<std::string, double> printed; ///< the paper's figures: samples, triangles, q
};

/** One table. */
struct Experiment
{
  std::string name;
  std::string title;
  std::string text; ///< after the table; see ComparisonRequest
  FieldRequest field;
  unsigned int seeds = 1;         ///< fields, or positions of the field on the lattice, over which figures are means
  std::vector<ComparedRow> rows;  ///< the first row is the reference of all ratios
  std::vector<std::string> views; ///< of the pictures, as ViewFromText() takes them
  bool hasPlot = false;           ///< of errors against samples and triangles, and against times
};

/** A statement of the paper. */
struct Claim
{
  std::string claim;
  std::string measured;
  std::string verdict;
};

/** A file of experiments. Texts may have figures in them: ${hand.2.mean} is that of row 2 of experiment hand, and
 * ${hand.2.mean/hand.1.mean} a ratio. */
struct ComparisonRequest
{
  std::string title;
  std::string text;
  std::vector<Experiment> experiments;
  std::vector<Claim> claims;
  bool hasLattices = false; ///< whether lattices and their cells are drawn
};

/** Reads a file of experiments. Throws Failure: NotFound, or Unreadable, with the mistake.
 * \param scans the folder in which scans are; empty: the file's own */
ComparisonRequest
ReadComparisonRequest(const std::filesystem::path & path, const std::filesystem::path & scans = {});

/** Figures of a row, by their names; pipelines/comparison/README.md has their meanings. Those without a value are
 * missing. */
using Figures = std::map<std::string, double>;

/** The results of one experiment. */
struct ExperimentResult
{
  Experiment experiment;
  double spacing = 0.0; ///< h, in the field's unit of length
  Figures truth;        ///< triangles, parts, genus of the true surface as a mesh, and facet of a field's
  std::vector<Figures> rows;
};

/** How experiments are run. */
struct ComparisonSettings
{
  std::filesystem::path output; ///< a folder; made if it is missing
  std::string only;             ///< name of the only experiment that is run, without claims; empty: all
  unsigned int repeats = 5;     ///< runs of each method, in turn, of which the median time is taken
  bool hasPictures = true;
};

/** Runs the experiments and writes into the folder: RESULTS.md, without times, so that it is the same on every machine;
 * figures.csv, figures.json and times.csv; plots as SVG and PNG and pictures as JPEG. Throws Failure. */
void
RunComparison(const ComparisonRequest & request, const ComparisonSettings & settings, const Events & events);

} // namespace rhombic

#endif
