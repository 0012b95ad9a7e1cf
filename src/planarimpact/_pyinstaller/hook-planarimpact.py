"""Tables, presets and templates, which PyInstaller does not find by imports."""

from PyInstaller.utils.hooks import collect_data_files, collect_submodules

datas, hiddenimports = collect_data_files("planarimpact"), collect_submodules("planarimpact")
