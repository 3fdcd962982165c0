#include "rhombicComparison.h"
#include "rhombicComparedMethod.h"
#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicYAMLKeys.h"
#include "rhombicWording.h"

#include <yaml-cpp/yaml.h>

#include <set>

namespace rhombic
{
namespace
{

/** A value by its key; the keys that are known are kept, to refuse all others. */
class Map
{
public:
  explicit Map(YAML::Node node)
    : m_Node(std::move(node))
  {}

  template <typename TValue>
  void
  Get(const std::string & key, TValue & value)
  {
    m_Known.insert(key);
    if (m_Node[key])
    {
      value = m_Node[key].as<TValue>();
    }
  }

  YAML::Node
  Get(const std::string & key)
  {
    m_Known.insert(key);
    return m_Node[key];
  }

  void
  RefuseOthers() const
  {
    for (const auto & entry : m_Node)
    {
      const auto key = entry.first.as<std::string>();
      if (m_Known.count(key) == 0)
      {
        throw Failure(
          FailureKind::Unreadable,
          DescribeUnknown(
            "key", key, { m_Known.begin(), m_Known.end() }, "compare with pipelines/comparison/paper.yaml"));
      }
    }
  }

private:
  YAML::Node m_Node;
  std::set<std::string> m_Known;
};

FieldRequest
ParseField(const YAML::Node & node, const std::filesystem::path & scans)
{
  FieldRequest field;
  Map map(node);
  map.Get("kind", field.kind);
  map.Get("object", field.object);
  map.Get("band-limit", field.bandLimit);
  map.Get("size", field.size);
  map.Get("pixels", field.pixels);
  map.Get("turn", field.turn);
  std::string file;
  map.Get("file", file);
  field.file = scans / file;
  map.Get("isovalue", field.isovalue);
  map.Get("spacing", field.spacing);
  map.Get("sigma", field.sigma);
  map.Get("center", field.center);
  map.RefuseOthers();
  return field;
}

ComparedRow
ParseRow(const YAML::Node & node)
{
  ComparedRow row;
  Map map(node);
  map.Get("method", row.method);
  map.Get("samples", row.samples);
  map.Get("density", row.density);
  map.Get("resampled", row.isResampled);
  map.Get("shown", row.isShown);
  map.Get("printed", row.printed);
  map.RefuseOthers();
  GetComparedMethod(row.method);
  return row;
}

Experiment
ParseExperiment(const YAML::Node & node, const std::filesystem::path & scans)
{
  Experiment experiment;
  Map map(node);
  map.Get("name", experiment.name);
  map.Get("title", experiment.title);
  map.Get("text", experiment.text);
  map.Get("seeds", experiment.seeds);
  map.Get("views", experiment.views);
  map.Get("plot", experiment.hasPlot);
  experiment.field = ParseField(map.Get("field"), scans);
  for (const auto & row : map.Get("rows"))
  {
    experiment.rows.push_back(ParseRow(row));
  }
  map.RefuseOthers();
  if (experiment.name.empty() || experiment.rows.empty() || experiment.seeds == 0)
  {
    throw Failure(FailureKind::Unreadable, "An experiment has no name, no rows or no seeds.");
  }
  return experiment;
}

} // namespace

ComparisonRequest
ReadComparisonRequest(const std::filesystem::path & path, const std::filesystem::path & scans)
{
  const std::string text = ReadTextFile(path, "file of experiments");
  try
  {
    ComparisonRequest request;
    Map map(LoadYAML(text));
    map.Get("title", request.title);
    map.Get("text", request.text);
    map.Get("lattices", request.hasLattices);
    for (const auto & node : map.Get("experiments"))
    {
      request.experiments.push_back(ParseExperiment(node, scans.empty() ? path.parent_path() : scans));
    }
    for (const auto & node : map.Get("claims"))
    {
      Map values(node);
      Claim & claim = request.claims.emplace_back();
      values.Get("claim", claim.claim);
      values.Get("measured", claim.measured);
      values.Get("verdict", claim.verdict);
      values.RefuseOthers();
    }
    map.Get("shared"); // rows that experiments refer to
    map.RefuseOthers();
    return request;
  }
  catch (const YAML::Exception & error)
  {
    throw Failure(FailureKind::Unreadable, path.string() + " is no file of experiments: " + error.what() + ".");
  }
  catch (const YAMLMistake & mistake)
  {
    throw Failure(FailureKind::Unreadable, path.string() + " " + mistake.what() + ".");
  }
}

} // namespace rhombic
