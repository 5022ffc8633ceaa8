"""Talus in QGIS: its tools and the goals of its pipeline as Processing algorithms."""


def classFactory(iface):  # the name that QGIS asks for
    from .plugin import TalusPlugin
    return TalusPlugin()
