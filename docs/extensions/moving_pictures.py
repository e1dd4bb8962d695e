"""Animations of the gallery as GIFs: pictures that move without a script."""

from matplotlib import pyplot
from matplotlib.animation import FuncAnimation
from sphinx_gallery.scrapers import figure_rst


def animations(block, block_vars, gallery_conf):
    """Write the animations that a block of an example made, and close their figures."""
    pictures = []
    made = [each for each in block_vars["example_globals"].values() if isinstance(each, FuncAnimation)]
    for animation in made:
        figure = animation._fig
        if pyplot.fignum_exists(figure.number):
            path = next(block_vars["image_path_iterator"]).replace(".png", ".gif")
            animation.save(path, writer="pillow", dpi=80)
            pictures.append(path)
            pyplot.close(figure)
    return figure_rst(pictures, gallery_conf["src_dir"])
