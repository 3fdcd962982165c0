#ifndef rhombicView_h
#define rhombicView_h

#include <array>
#include <string>

namespace rhombic
{

/** \file
 * The six standard views. */

/** The side of the patient that is seen: View::Left shows the patient's left side. */
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

/** A view's axes, as LPS unit vectors: right = look x up. */
struct ViewFrame
{
  using DirectionType = std::array<int, 3>;

  DirectionType look;  ///< from the viewer into the picture
  DirectionType up;    ///< towards the picture's top edge
  DirectionType right; ///< towards the picture's right edge
};

/** The anatomical direction at each edge of a picture: L, R (left, right), A, P (anterior, posterior), H or F (head,
 * foot). */
struct EdgeLetters
{
  char left;
  char right;
  char top;
  char bottom;
};

/** The head is up in the anterior, posterior and lateral views. In the superior and inferior views the front of the
 * body is up; the inferior view has the usual orientation of axial slices. */
ViewFrame
FrameOf(View view);

/** The letters at the edges of a view's picture. */
EdgeLetters
EdgeLettersOf(View view);

/** "anterior", "posterior", "left", "right", "superior" or "inferior". */
std::string
NameOf(View view);

/** The view with this name, in upper or lower case. Throws Failure(Usage), listing the names, when there is none. */
View
ViewFromName(const std::string & name);

} // namespace rhombic

#endif
