#include "rhombicView.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <itksys/SystemTools.hxx>

namespace rhombic
{
namespace
{

using DirectionType = ViewFrame::DirectionType;

constexpr DirectionType Leftwards{ 1, 0, 0 };
constexpr DirectionType Rightwards{ -1, 0, 0 };
constexpr DirectionType Backwards{ 0, 1, 0 };
constexpr DirectionType Forwards{ 0, -1, 0 };
constexpr DirectionType Headwards{ 0, 0, 1 };
constexpr DirectionType Footwards{ 0, 0, -1 };

DirectionType
Cross(const DirectionType & a, const DirectionType & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

ViewFrame
MakeFrame(const DirectionType & look, const DirectionType & up)
{
  return { look, up, Cross(look, up) };
}

DirectionType
Opposite(const DirectionType & direction)
{
  return { -direction[0], -direction[1], -direction[2] };
}

char
LetterOf(const DirectionType & direction)
{
  constexpr char letters[3][2] = { { 'R', 'L' }, { 'A', 'P' }, { 'F', 'H' } };
  const int axis = direction[0] != 0 ? 0 : (direction[1] != 0 ? 1 : 2);
  return letters[axis][direction[axis] > 0];
}

} // namespace

ViewFrame
FrameOf(View view)
{
  switch (view)
  {
    case View::Anterior:
      return MakeFrame(Backwards, Headwards);
    case View::Posterior:
      return MakeFrame(Forwards, Headwards);
    case View::Left:
      return MakeFrame(Rightwards, Headwards);
    case View::Right:
      return MakeFrame(Leftwards, Headwards);
    case View::Superior:
      return MakeFrame(Footwards, Forwards);
    case View::Inferior:
      return MakeFrame(Headwards, Forwards);
  }
  throw Failure(FailureKind::Internal, "View " + std::to_string(static_cast<int>(view)) + " does not exist.");
}

EdgeLetters
EdgeLettersOf(View view)
{
  const ViewFrame frame = FrameOf(view);
  return { LetterOf(Opposite(frame.right)), LetterOf(frame.right), LetterOf(frame.up), LetterOf(Opposite(frame.up)) };
}

std::string
NameOf(View view)
{
  switch (view)
  {
    case View::Anterior:
      return "anterior";
    case View::Posterior:
      return "posterior";
    case View::Left:
      return "left";
    case View::Right:
      return "right";
    case View::Superior:
      return "superior";
    case View::Inferior:
      return "inferior";
  }
  throw Failure(FailureKind::Internal, "View " + std::to_string(static_cast<int>(view)) + " does not exist.");
}

View
ViewFromName(const std::string & name)
{
  const std::string lowerCase = itksys::SystemTools::LowerCase(name);
  std::vector<std::string> names;
  for (const View view : AllViews)
  {
    if (lowerCase == NameOf(view))
    {
      return view;
    }
    names.push_back(NameOf(view));
  }
  throw Failure(FailureKind::Usage, DescribeUnknown("view", name, names, "use " + Enumerate(names)));
}

} // namespace rhombic
