"""The plug-in that QGIS loads: adds the provider, and takes it away again."""
from qgis.core import QgsApplication


class TalusPlugin:
    def __init__(self):
        self.provider = None

    def initProcessing(self):
        from .provider import TalusProvider
        self.provider = TalusProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
