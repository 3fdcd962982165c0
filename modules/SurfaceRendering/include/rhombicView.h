#ifndef rhombicView_h
#define rhombicView_h

#include <array>
#include <string>

namespace rhombic
{

/** \file
 * The six standard views. Thread safety: the structs are values, and the functions pure. */

/** Where the viewer stands, as an anatomist names it: View::Left is the view of the patient's left side. */
enum class View
{
  Anterior,
  Posterior,
  Left,
  Right,
  Superior,
  Inferior
};

inline constexpr std::array<View, 6> AllViews{ View::Anterior, View::Posterior, View::Left,
                                               View::Right,    View::Superior,  View::Inferior };

/** A view's axes as LPS unit vectors. They are right-handed: right = look x up. */
struct ViewFrame
{
  using DirectionType = std::array<int, 3>;

  DirectionType look;  ///< from the viewer into the picture
  DirectionType up;    ///< to the picture's top edge
  DirectionType right; ///< to the picture's right edge
};

/** The letters of the anatomical directions that lie towards a picture's edges. */
struct EdgeLetters
{
  char left;
  char right;
  char top;
  char bottom;
};

/** The patient stands upright in the anterior, posterior and lateral views. In the superior and inferior views the
 * front of the body is up; the inferior one is the axial slice's usual orientation. */
ViewFrame
FrameOf(View view);

/** L, R (left, right), A, P (anterior, posterior), H or F (head, foot) at each edge of the picture. */
EdgeLetters
EdgeLettersOf(View view);

/** "anterior", "posterior", "left", "right", "superior" or "inferior". */
std::string
NameOf(View view);

/** The view of that name, in any case of letters. Throws Failure(Usage), listing the names, when there is none. */
View
ViewFromName(const std::string & name);

} // namespace rhombic

#endif
